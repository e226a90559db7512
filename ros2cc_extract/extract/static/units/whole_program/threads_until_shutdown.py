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
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import CLOCKS
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
    return loop if spins_end_by_themselves(world) else None


def is_shut_down(over: Iterable[Over]) -> bool:
    """Whether the program may have shut rclpy down among what it has ended."""
    return any(each.what is None for each in over)


def _is_shut_down_beside(world: RosWorld) -> bool:
    doers = (end.doer for end in world.ends if end.kind == SHUTDOWN)
    return any(getattr(doer, 'kind', None) is not ActivityKind.MAIN for doer in doers)


def spins_end_by_themselves(world: RosWorld) -> bool:
    """Whether the main program spins, and each time it has ended rclpy is still up."""
    spins = [spin for spin in world.spins.values() if not spin.in_thread]
    return bool(spins) and all(ends_by_itself(spin, world) for spin in spins)


def ends_by_itself(spin: Spin, world: RosWorld) -> bool:
    """Whether it does one thing, and no loop repeats it until rclpy is shut down."""
    places = {spin.place, *(place for chain in spin.chains for place in chain)}
    is_short = not spin.for_ever and spin.how.endswith(_ONCE)
    return is_short and all(_ends(loop) for place in places for loop in loops_around(place, world))


def _ends(loop: ast.While) -> bool:
    """Whether it has an end of its own, which nothing ties to that of rclpy."""
    test, tests = loop.test, [loop.test]
    if isinstance(test, ast.BoolOp) and isinstance(test.op, ast.And):
        tests = test.values
    own = [each for each in tests if not _asks(each) and not _is_true(each)]
    parts = [part for each in (*own, *loop.body) for part in walk(each)]
    if any(map(_asks, parts)):
        return False
    caught = {
        id(inside)
        for part in parts
        if isinstance(part, ast.ExceptHandler)
        for inside in walk(part)
    }
    left = (part for part in parts if isinstance(part, (ast.Break, ast.Return)))
    return bool(own) or any(id(part) not in caught for part in left)


def ends_by_time(spin: Spin, world: RosWorld) -> bool:
    """Whether it ends so by a number of rounds, a time-out or a time, and by no thread's work."""
    places = {spin.place, *(place for chain in spin.chains for place in chain)}
    loops = (loop for place in places for loop in loops_around(place, world))
    return ends_by_itself(spin, world) and all(map(_asks_a_clock, loops))


def spins_until_one_ends(world: RosWorld) -> bool:
    """Whether the main program spins as long as some thread is alive, which it joins then."""
    spins = (spin for spin in world.spins.values() if not spin.in_thread)
    loops = (loop for spin in spins for loop in loops_around(spin.place, world))
    return any(_called(part) == 'is_alive' for loop in loops for part in walk(loop.test))


def _asks_a_clock(loop: ast.While) -> bool:
    return any(_called(part) in CLOCKS for part in walk(loop.test))


def _asks(part: ast.AST) -> bool:
    """Whether it is ``rclpy.ok()``, or asks a thread whether it is over."""
    return _called(part) in ('ok', 'is_alive')


def _called(part: ast.AST) -> str:
    function = part.func if isinstance(part, ast.Call) else None
    name: str = getattr(function, 'attr', getattr(function, 'id', ''))
    return name


def _is_true(test: ast.expr) -> bool:
    return isinstance(test, ast.Constant) and bool(test.value)


def loops_around(place: Place, world: RosWorld) -> Iterator[ast.While]:
    """The loops that a line stands in, within its function."""
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
