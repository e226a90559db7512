"""What we tell a developer about his node: one finding at one line."""

from __future__ import annotations

from dataclasses import dataclass

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.places import Place


@dataclass(frozen=True, kw_only=True)
class Finding:
    """
    One finding.

    :param code: of the rule, ``CC101``.
    :param severity: a note never changes the exit status.
    :param evidence: lines of the shortest evidence, empty where the line itself is it.
    """

    code: str
    severity: Severity
    place: Place
    message: str
    help: str = ''
    evidence: tuple[str, ...] = ()
