"""
Threads that run ``while rclpy.ok()``, and are waited for before rclpy is shut down.

Where the spin of the program ends by itself, as by a time or an answer, rclpy goes on, and so does
such a thread; who is asked to end by a signal has shut rclpy down by then (rclpy 7.1.6,
``signals.py``).
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import (
    ActivityState,
    OutsideWait,
    Over,
)
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import JOIN
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import SHUTDOWN
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld, Spin
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import ActivityKind

_ONCE = ('spin_once', 'spin_until_future_complete')
_INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)


def joined_while_ok(wait: OutsideWait, world: RosWorld) -> Iterator[Diagnostic]:
    """The thread that ``wait`` joins, if only the end of rclpy ends it, which comes later."""
    if wait.in_thread or not wait.is_called or is_shut_down(wait.over):
        return
    for state in world.activities:
        if any(wait.client is runner for runner in state.runners) and not state.serves:
            loop = runs_on(state, world)
            if loop is not None:
                yield _diagnostic(wait, loop)
                return


def runs_on(state: ActivityState, world: RosWorld) -> Place | None:
    """The loop of a thread that goes on when the spins behind its start are over."""
    loop = state.until_shutdown
    if loop is None or state.spins >= world.main_spins or _is_shut_down_beside(world):
        return None
    spins = [spin for spin in world.spins.values() if not spin.in_thread]
    return loop if spins and all(_ends_by_itself(spin, world) for spin in spins) else None


def is_shut_down(over: Iterable[Over]) -> bool:
    """Whether the program may have shut rclpy down among what it has ended."""
    return any(each.what is None for each in over)


def _is_shut_down_beside(world: RosWorld) -> bool:
    doers = (end.doer for end in world.ends if end.kind == SHUTDOWN)
    return any(getattr(doer, 'kind', None) is not ActivityKind.MAIN for doer in doers)


def _ends_by_itself(spin: Spin, world: RosWorld) -> bool:
    """Whether it does one thing, and no loop repeats it until rclpy is shut down."""
    places = {spin.place, *(place for chain in spin.chains for place in chain)}
    is_short = not spin.for_ever and spin.how.endswith(_ONCE)
    return is_short and all(_ends(loop) for place in places for loop in _around(place, world))


def _ends(loop: ast.While) -> bool:
    """Whether its text has an end of its own, and nothing that asks whether rclpy is up."""
    parts = list(walk(loop))
    if any(getattr(part, 'attr', getattr(part, 'id', '')) == 'ok' for part in parts):
        return False
    is_for_ever = isinstance(loop.test, ast.Constant) and bool(loop.test.value)
    return not is_for_ever or any(isinstance(part, (ast.Break, ast.Return)) for part in parts)


def _around(place: Place, world: RosWorld) -> Iterator[ast.While]:
    """The loops of a function that a line of it stands in."""
    for tree, file in world.files:
        if file == place.file:
            loops = [part for part in walk(tree) if isinstance(part, ast.While)]
            inner = [part for part in walk(tree) if isinstance(part, _INNER)]
            own = max((_first(each) for each in inner if _has(each, place)), default=0)
            yield from (loop for loop in loops if loop.lineno > own and _has(loop, place))


def _has(part: ast.AST, place: Place) -> bool:
    last = getattr(part, 'end_lineno', None)
    return _first(part) <= place.line <= (last or 0)


def _first(part: ast.AST) -> int:
    return getattr(part, 'lineno', 0)


def _diagnostic(wait: OutsideWait, loop: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='nobody-spins',
        place=wait.place,
        message=f'{JOIN} waits for a thread that runs while rclpy.ok() ({loop}), and rclpy is not '
        'shut down before: it may wait forever',
        help='shut rclpy down before the join, or let the loop of the thread ask for an event '
        'too, and set that before',
    )
