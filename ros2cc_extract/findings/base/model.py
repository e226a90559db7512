"""What a developer reads about a node: one finding at one line, with what shows it."""

from __future__ import annotations

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.results.evidence import Evidence


@dataclass(frozen=True)
class Remark:
    """A place that belongs to a finding, with what happens there."""

    place: Place
    text: str


@dataclass(frozen=True)
class OnNode:
    """
    What came of a finding on the running node.

    :param outcome: ``confirmed``, ``not reached`` or ``contradicted``.
    :param release: of rclpy, where it is known.
    :param reason: what was seen, or what is missing.
    :param evidence: several lines that show it; may be empty.
    :param run: the last steps that the node took, each in words.
    """

    outcome: str
    release: str | None
    reason: str
    evidence: str = ''
    run: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """Say it in a line."""
        on = f'rclpy {self.release}' if self.release else 'rclpy'
        return f'{self.outcome} on {on}: {self.reason}'


@dataclass(frozen=True, kw_only=True)
class Finding:
    """
    One finding.

    :param code: of the rule, ``CC101``.
    :param severity: a note never changes the exit status.
    :param unit: name of the verification unit it is about; ``None`` for a file as such.
    :param subjects: names of the callbacks, groups or executors concerned; they identify the
        finding across edits that move lines.
    :param chain: calls that lead to ``place``, outermost first.
    :param related: other places to look at, such as where a group was made.
    :param run: a run of the model that shows it.
    :param help: how to mend it, in one clause.
    :param on_node: what came of it on the running node, where that was tried.
    :param cause: what is behind it, where one cause may show in several units; reported once.
    """

    code: str
    severity: Severity
    place: Place
    message: str
    help: str = ''
    unit: str | None = None
    subjects: tuple[str, ...] = ()
    chain: tuple[Remark, ...] = ()
    related: tuple[Remark, ...] = ()
    run: Evidence | None = None
    cause: str = ''
    on_node: OnNode | None = None
