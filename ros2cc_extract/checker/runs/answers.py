"""What a check answers: a verdict for each query, with a run that shows it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field
from functools import cached_property

from ros2cc_extract.checker.engines.search import INTERRUPTED
from ros2cc_extract.checker.engines.terms import Verdict
from ros2cc_extract.checker.runs.run import Run
from ros2cc_extract.checker.uppaal.files.query_file import Query
from ros2cc_extract.light_dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Answer:
    """
    The verdict of one query.

    :param reason: why the verdict is undecided.
    :param seconds: when it was known, from the start of the search.
    :param replay: gives the witness or counterexample; None where none exists or was found.
    """

    query: Query
    verdict: Verdict
    reason: str | None
    seconds: float
    replay: Callable[[], Run] | None = field(repr=False, compare=False)

    @property
    def is_interrupted(self) -> bool:
        """Whether a Ctrl-C left it undecided."""
        return self.reason == INTERRUPTED

    @cached_property
    def path(self) -> Run | None:
        """
        The witness or counterexample, replayed step by step when it is first asked for.

        :raises CoreMismatchError: when it could not be replayed (a defect).
        """
        return self.replay() if self.replay else None

    def shown(self) -> Run:
        """Return the path for the opposite query; there must be one."""
        assert self.path is not None
        return self.path


@dataclass(frozen=True, kw_only=True)
class CheckResult:
    """
    Answers to all queries.

    :param engine: name of the engine that searched.
    :param note: what the user should know about the choice of the engine; often empty.
    :param complete: whether all reachable states were explored.
    """

    engine: str
    note: str = ''
    states: int
    transitions: int
    seconds: float
    peak_mb: float
    complete: bool
    answers: tuple[Answer, ...]
