"""What one search has found of a unit, or several together, by what each query is about."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from ros2cc_extract.checker.api import CheckResult, Limits, Verdict
from ros2cc_extract.generator.build import Family, Query
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.results.results import QueryResult, open_result

SLICE_STATES = 200_000
Key = tuple[Family, tuple[str, ...], tuple[str, ...]]


def key_of(query: Query) -> Key:
    """What a query is about; equal in a unit and in its slices."""
    return query.family, query.callbacks, query.groups


@dataclass(frozen=True)
class Found:
    """
    What one search has found, or several together.

    :param check: of the whole unit or of the first slice; counts are of all.
    :param by_slices: how many results are from slices.
    """

    results: dict[Key, QueryResult]
    check: CheckResult
    by_slices: int = 0


Search = Callable[[ClosedSpec, Sequence[Key], Limits], Found]


def weighs_more(new: QueryResult, old: QueryResult) -> bool:
    """Of slices asked for a deadlock one that has one decides, then one that may have one."""
    return _WEIGHTS[new.verdict] > _WEIGHTS[old.verdict]


_WEIGHTS = {Verdict.NOT_SATISFIED: 2, Verdict.UNDECIDED: 1, Verdict.SATISFIED: 0}


def total(checks: Sequence[CheckResult]) -> CheckResult:
    """One check for several: of the first, with the counts of all."""
    return replace(
        checks[0],
        states=sum(check.states for check in checks),
        transitions=sum(check.transitions for check in checks),
        seconds=sum(check.seconds for check in checks),
        peak_mb=max(check.peak_mb for check in checks),
    )


def unasked(queries: Iterable[Query], keys: Sequence[Key], limits: Limits) -> Found:
    """What is open when the time is over before a unit could be asked."""
    reason = limits.deadline.reason if limits.deadline else ''
    wanted = set(keys)
    left = [query for query in queries if key_of(query) in wanted]
    check = CheckResult(
        engine='none',
        note='',
        states=0,
        transitions=0,
        seconds=0.0,
        peak_mb=0.0,
        complete=False,
        answers=(),
    )
    return Found({key_of(query): open_result(query, reason) for query in left}, check)
