"""What is known of a model: its verdicts, each with its evidence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import replace
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING

from ros2cc_extract.checker.engines.terms import Verdict as Verdict
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.load import Load

if TYPE_CHECKING:
    from ros2cc_extract.checker.api import CheckResult
    from ros2cc_extract.generator.build import Query

MOST_RUNS = 100
"""Of one family and verdict: to find each takes a search, and pairs come by the ten thousand."""


class NotKept(Enum):
    """Stands for a run that was found and stayed behind: it can be found again."""

    RUN = 'run'


@dataclass(frozen=True, kw_only=True)
class QueryResult:
    """
    One verdict with its evidence.

    :param family: value of ``generator.build.Family``; ``None`` for a query we did not write.
    :param callbacks: names of the callbacks the query is about.
    :param seconds: when it was decided, counted from the start of the exploration.
    :param load: what the rates say, beside a verdict of profile rclpy on starvation.
    :param run: the run behind the verdict, or what gives it; use ``evidence``.
    :param in_doubt: undecided because of what is not known, and not of a limit.
    :param repeated: names of callbacks of which several runs at a time matter to the verdict.
    """

    family: str | None
    formula: str
    words: str
    callbacks: tuple[str, ...]
    verdict: Verdict
    reason: str | None
    seconds: float
    run: Evidence | Callable[[], Evidence] | NotKept | None
    load: Load | None = None
    in_doubt: bool = False
    repeated: tuple[str, ...] = ()

    @cached_property
    def evidence(self) -> Evidence | None:
        """The run behind the verdict, replayed and worded when it is first asked for."""
        assert not isinstance(self.run, NotKept), 'put back before anybody asks'
        return self.run() if callable(self.run) else self.run


@dataclass(frozen=True, kw_only=True)
class Verification:
    """
    All verdicts of one model.

    :param peak_mb: largest resident memory of the process, in MB.
    :param complete: false when a limit ended the exploration.
    :param assumptions: what was decided about open facts of the unit, in words.
    :param notes: what else the reader should know, such as a checker that could not be used.
    :param defect: what went wrong in this tool, so that nothing was decided; mostly empty.
    """

    model: str
    profile: str | None
    text: str | None
    engine: str
    states: int
    transitions: int
    seconds: float
    peak_mb: float
    complete: bool
    results: tuple[QueryResult, ...]
    assumptions: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    defect: str = ''

    @property
    def is_cut(self) -> bool:
        """True when a limit left a query open of which nothing else was in doubt."""
        return any(
            result.verdict is Verdict.UNDECIDED and not result.in_doubt for result in self.results
        )

    @cached_property
    def by_callbacks(self) -> Mapping[tuple[str | None, frozenset[str]], QueryResult]:
        """The first result of each family on the same callbacks, in any order."""
        found: dict[tuple[str | None, frozenset[str]], QueryResult] = {}
        for result in self.results:
            found.setdefault((result.family, frozenset(result.callbacks)), result)
        return found

    @property
    def is_undecided(self) -> bool:
        """True when a limit left at least one query open."""
        return any(result.verdict is Verdict.UNDECIDED for result in self.results)


def with_fewer_runs(verification: Verification) -> Verification:
    """Leave the first runs of each family and verdict; how many others there are is noted."""
    seen: Counter[tuple[str | None, Verdict]] = Counter()
    results = []
    for result in verification.results:
        kind = result.family, result.verdict
        seen[kind] += result.run is not None
        is_beyond = result.run is not None and seen[kind] > MOST_RUNS
        results.append(replace(result, run=None) if is_beyond else result)
    left_out = sum(max(0, count - MOST_RUNS) for count in seen.values())
    if not left_out:
        return verification
    note = (
        f'the runs behind {left_out} verdicts are left out: of each kind of claim the first '
        f'{MOST_RUNS} are shown, and --query asks for any other'
    )
    return replace(verification, results=tuple(results), notes=(*verification.notes, note))


def open_result(query: Query, reason: str) -> QueryResult:
    """The answer to a query that was not asked, or not to the end."""
    return QueryResult(
        family=query.family.value,
        formula=query.formula,
        words=query.words,
        callbacks=query.callbacks,
        verdict=Verdict.UNDECIDED,
        reason=reason,
        seconds=0.0,
        run=None,
    )


def verification_of(
    model: str,
    result: CheckResult,
    results: tuple[QueryResult, ...],
    *,
    profile: str | None = None,
    text: str | None = None,
    assumptions: tuple[str, ...] = (),
    notes: tuple[str, ...] = (),
) -> Verification:
    """Tie results to what the search that found them has used."""
    return Verification(
        model=model,
        profile=profile,
        text=text,
        engine=result.engine,
        states=result.states,
        transitions=result.transitions,
        seconds=result.seconds,
        peak_mb=result.peak_mb,
        complete=result.complete,
        results=results,
        assumptions=assumptions,
        notes=(*([result.note] if result.note else []), *notes),
    )
