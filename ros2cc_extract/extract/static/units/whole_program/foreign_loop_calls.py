"""
What belongs to a loop of asyncio and is touched by a thread that does not run the loop.

Neither ``put_nowait`` nor ``set`` nor ``call_soon`` wakes a loop that waits for something to come,
and none of them is made for two threads (Python, library reference, *Developing with asyncio*).
Which thread runs a loop must be known, and none of those that spin may run one.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import LoopTouch
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    ExecutorState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.values.values import Instance, options_of
from ros2cc_extract.spec.model import ActivityKind

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


def _threads_of(doer: object, world: RosWorld) -> Iterator[int]:
    """Which threads may do it; nothing where that is not known. Those of a pool have no number."""
    if isinstance(doer, ActivityState):
        yield 0 if doer.kind is ActivityKind.MAIN else doer.thread
        return
    assert isinstance(doer, EntityState)
    for spin in world.spins.values():
        added = spin.executor.slots.get('__nodes__', ())
        nodes = (*spin.nodes, *(option for entry in added for option in options_of(entry)))
        if any(node is doer.node for node in nodes):
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
