"""
What belongs to a loop of asyncio and is touched by a thread that does not run the loop.

Neither ``put_nowait`` nor ``set`` nor ``call_soon`` wakes a loop that waits for something to come,
and none of them is made for two threads (Python, library reference, *Developing with asyncio*).
Which thread runs a loop must be known, and none of those that spin may run one.

What needs a loop in its own thread raises ``RuntimeError`` where none runs; ``ensure_future``
takes that of the main thread, if nothing runs it either. Sources: CPython 3.12,
``asyncio/events.py`` (``get_running_loop``; ``get_event_loop`` makes a loop in the main thread
alone); measured under rclpy 7.1.6 and 9.1.2, where the error leaves the spin.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import LoopAsk, LoopTouch
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    LOOP_KIND,
    EntityState,
    ExecutorState,
    RosWorld,
    Spin,
)
from ros2cc_extract.extract.static.python.values.values import Instance, options_of
from ros2cc_extract.spec.model import ActivityKind

_ENSURE = 'asyncio.ensure_future'
_OF_THE_LOOP = frozenset({'call_soon', 'create_task'})


def note_foreign_loops(world: RosWorld) -> None:
    """Report what a thread other than that of the loop does to what belongs to the loop."""
    of_loops = {run.thread for run in world.loop_runs}
    of_loops |= {each.thread for each in world.activities if each.on_loop}
    if not world.loop_runs:
        return
    for touch in world.loop_touches:
        threads = set(_threads_of(touch.doer, world))
        if threads and not threads & of_loops and _is_awaited(touch, world):
            world.diagnostics.append(_foreign(touch))


def note_missing_loops(world: RosWorld) -> None:
    """Report what callbacks ask of a loop that does not run in any thread that serves them."""
    for ask in world.loop_asks:
        assert isinstance(ask.doer, EntityState)
        spins = list(_spins_of(ask.doer, world))
        if ask.doer.is_on_loop or not spins or any(map(_may_have_loop, spins)):
            continue
        threads = set(_threads_of(ask.doer, world))
        if not ask.is_any or (0 not in threads and not world.sets_loops):
            world.diagnostics.append(_missing(ask))
        elif ask.how == _ENSURE and threads == {0} and not _runs_in_main(world):
            world.diagnostics.append(_never_run(ask))


def _may_have_loop(spin: Spin) -> bool:
    """Whether a loop may run in the threads of its executor: those of a pool have none."""
    state = spin.executor.state
    if not isinstance(state, ExecutorState) or state.kind == LOOP_KIND:
        return True
    is_known = state.unknown is None and state.unresolved is None
    return not is_known or (spin.may_have_loop and state.threads == 1)


def _runs_in_main(world: RosWorld) -> bool:
    return world.sets_loops or any(run.thread == 0 for run in world.loop_runs)


def _spins_of(doer: EntityState, world: RosWorld) -> Iterator[Spin]:
    for spin in world.spins.values():
        added = spin.executor.slots.get('__nodes__', ())
        nodes = (*spin.nodes, *(option for entry in added for option in options_of(entry)))
        if any(node is doer.node for node in nodes):
            yield spin


def _threads_of(doer: object, world: RosWorld) -> Iterator[int]:
    """Which threads may do it; nothing where that is not known. Those of a pool have no number."""
    if isinstance(doer, ActivityState):
        yield 0 if doer.kind is ActivityKind.MAIN else doer.thread
        return
    assert isinstance(doer, EntityState)
    for spin in _spins_of(doer, world):
        state = spin.executor.state
        has_pool = isinstance(state, ExecutorState) and state.threads != 1
        yield -1 if has_pool else spin.thread


def _is_awaited(touch: LoopTouch, world: RosWorld) -> bool:
    """Whether a coroutine waits for it; of a loop, whether a thread is known to run it."""
    if touch.how in _OF_THE_LOOP:
        return any(
            option is touch.thing for run in world.loop_runs for option in options_of(run.loop)
        )
    return any(thing is touch.thing for thing in world.awaited_of_loops)


def _foreign(touch: LoopTouch) -> Diagnostic:
    thing = touch.thing
    name = thing.hint if isinstance(thing, Instance) and thing.hint else 'an asyncio object'
    is_loop = touch.how in _OF_THE_LOOP
    instead = 'loop.call_soon_threadsafe(…)'
    if touch.how == 'create_task':
        instead = 'asyncio.run_coroutine_threadsafe(coroutine, loop)'
    whose = (
        f'{name}, which another thread runs'
        if is_loop
        else (f'{name}, which a coroutine awaits in the loop of another thread')
    )
    return Diagnostic(
        severity=Severity.WARNING,
        slug='foreign-loop',
        place=touch.place,
        message=f'{touch.how} touches {whose}: it does not wake that loop, which may wait '
        'forever, and is not thread-safe',
        help=f'hand it over to the loop: {instead}',
    )


def _missing(ask: LoopAsk) -> Diagnostic:
    return Diagnostic(
        severity=Severity.ERROR,
        slug='no-running-loop',
        place=ask.place,
        message=f'{ask.how} needs an asyncio loop that runs in its thread, and none runs where '
        'this callback is served: it raises RuntimeError, which ends the spin',
        help=_INSTEAD,
    )


def _never_run(ask: LoopAsk) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='lost-task',
        place=ask.place,
        message=f'{ask.how} leaves the coroutine to the asyncio loop of the main thread, which '
        'nothing runs: none of its code ever runs; from Python 3.14 on it raises RuntimeError',
        help=_INSTEAD,
    )


_INSTEAD = (
    'run a loop in a thread of its own, and hand the coroutine over by '
    'asyncio.run_coroutine_threadsafe(coroutine, loop)'
)
