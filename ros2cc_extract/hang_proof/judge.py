"""
Asks the model whether anything can end what waits forever by the wait-for graph.

The snapshot is a set of states of the unit's model: each callback that waits has begun, has asked
or waits for its signal, and neither answer nor signal is there. A watcher in the model marks what
comes after such a state. If no answer and no signal ever comes then, nothing that waits ever ends,
from any state of the snapshot on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import Enum

from ros2cc_extract.checker.api import Limits, Query, Verdict
from ros2cc_extract.errors import Ros2ccError
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Verdict as Hang
from ros2cc_extract.generator.template_files import Profile
from ros2cc_extract.hang_proof.snapshot_unit import (
    SnapshotUnit,
    StandingRun,
    UnprovableError,
    unit_of,
)
from ros2cc_extract.spec.close import Policy, close
from ros2cc_extract.verify.given_queries import ask_unit
from ros2cc_extract.verify.search.options import Options

# As long as a user may be made to wait for it.
SECONDS = 3.0
_MEMORY_MB = 1000.0


class Outcome(Enum):
    """What the model says of the waits of a snapshot."""

    PROVEN = 'proven by the model'
    CAN_END = 'the model can end it'
    NOT_PROVEN = 'not proven by the model'


def judged(explanation: Explanation) -> Explanation:
    """
    Put what the model says beside a *deadlock* of the graph; other verdicts stay as they are.

    Where the model has a run in which a wait ends, the verdict becomes *undecided*.
    """
    if explanation.verdict is not Hang.DEADLOCK:
        return explanation
    outcome, reason = judge(explanation)
    if outcome is Outcome.PROVEN:
        return replace(explanation, proof='proven by the model')
    if outcome is Outcome.CAN_END:
        return replace(
            explanation,
            verdict=Hang.UNDECIDED,
            proof='a deadlock by the wait-for graph, but in the model a wait can end',
        )
    return replace(explanation, proof=f'by the wait-for graph; not proven by the model: {reason}')


def judge(explanation: Explanation) -> tuple[Outcome, str]:
    """Decide whether a wait of a snapshot can end; with the reason where that is not decided."""
    try:
        unit = unit_of(explanation)
        is_there, never_ends = _asked(unit)
    except UnprovableError as error:
        return Outcome.NOT_PROVEN, str(error)
    except Ros2ccError as error:
        return Outcome.NOT_PROVEN, error.what
    if never_ends[0] is Verdict.NOT_SATISFIED:
        return Outcome.CAN_END, ''
    if is_there[0] is Verdict.NOT_SATISFIED:
        return Outcome.NOT_PROVEN, 'the model does not come to this state'
    for verdict, reason in (is_there, never_ends):
        if verdict is Verdict.UNDECIDED:
            return Outcome.NOT_PROVEN, reason or 'a limit of the search was reached'
    return Outcome.PROVEN, ''


def _asked(
    unit: SnapshotUnit,
) -> tuple[tuple[Verdict, str | None], tuple[Verdict, str | None]]:
    over = ' or '.join(_is_over(each) for each in unit.standing)
    queries = [
        Query('E<> watcher.seen', 'the model comes to the snapshot', None),
        Query(f'A[] not (watcher.seen and ({over}))', 'nothing that waits ever ends', None),
    ]
    options = Options(
        profile=Profile.RCLPY,
        max_cycle=1,
        limits=Limits(seconds=SECONDS, memory_mb=_MEMORY_MB),
    )
    closed = replace(close(unit.spec, Policy(builtin=True)), arrivals=unit.arrivals)
    found = ask_unit(closed, queries, options, watched=_snapshot(unit.standing))
    first, second = ((result.verdict, result.reason) for result in found.results)
    return first, second


def _snapshot(standing: Sequence[StandingRun]) -> str:
    """All of it is there at once; only what waits asks, and only what waits counts as a waiter."""
    found = []
    for run in standing:
        who = run.callback
        begun = f'cb_suspended[{who}]' if run.is_suspended else f'cb_runs({who})'
        alike = sum(other.runs for other in standing if _waited_for(other) == _waited_for(run))
        found.append(f'{begun} >= {run.runs}')
        found.append(f'{_waited_for(run)} >= {alike} and !({_is_over(run)})')
    return ' and '.join(dict.fromkeys(found))


def _waited_for(run: StandingRun) -> str:
    """How many wait where a run does, by the declarations of the templates."""
    if run.client is not None:
        return f'cb_asked[{run.client}]'
    return f'resource_waiters[cb_resource_table[{run.callback}][0]]'


def _is_over(run: StandingRun) -> str:
    """The client has run and got the answer, or there is a signal."""
    if run.client is not None:
        return f'cb_is_answered({run.client})'
    return f'resource_signals[cb_resource_table[{run.callback}][0]] > 0'
