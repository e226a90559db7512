"""
Threads that keep the program when ``main`` is over, as nothing ends their waits.

The interpreter waits at its end for each thread that is no daemon, and for all threads of pools
(CPython 3.12, ``threading.py``, ``_shutdown``; ``concurrent/futures/thread.py``,
``_python_exit``): it is as if ``main`` joined them. Measured with rclpy 7.1.6: a program whose
thread stands in ``Queue.get`` outlives Ctrl-C.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, OutsideWait
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import JOIN, in_words
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import executor_of
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.recorded_effects import way_of
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.extract.static.units.whole_program.joined_threads import (
    BEHIND,
    NEVER_CLEARED,
    NOT_SPUN,
    comes_back,
    is_reported,
    may_leave,
    why_for_ever,
)
from ros2cc_extract.extract.static.units.whole_program.threads_until_shutdown import (
    is_shut_down,
    runs_on,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import WORKING_LOOP, Blocking
from ros2cc_extract.spec.model import ActivityKind

_ENDING_AT_ONCE = frozenset({'_exit', 'abort', 'kill', 'killpg', 'execv'})
Serving = Callable[[OutsideWait], Sequence[Instance]]


def kept_at_exit(world: RosWorld, spun_beside: Serving) -> Iterator[Diagnostic]:
    """
    Report each thread that waits forever when the program has spun, once.

    :param spun_beside: gives the nodes that threads still spin at a wait of ``main``.
    """
    is_followed = world.is_program and world.spins and not world.cut
    if not is_followed or _ends_at_once(world):
        return
    for state in world.activities:
        if state.again is not None and _is_chain(state, world):
            yield _goes_on(state, state.again)
        for runner in state.runners if _is_waited_for(state, world) else ():
            if not isinstance(runner, Instance):
                continue
            if state.endless is not None:
                yield _endless(state, state.endless)
                break
            loop = None if is_shut_down(world.over) else runs_on(state, world)
            if loop is not None:
                yield _until_shutdown(state, loop)
                break
            exit_wait = OutsideWait(
                JOIN, runner, state.place, in_thread=False, is_late=True, over=tuple(world.over)
            )
            found = next(_stuck_blocks(state, exit_wait, world, spun_beside(exit_wait)), None)
            if found is not None:
                yield _diagnostic(state, *found)
                break


def _ends_at_once(world: RosWorld) -> bool:
    """Whether a text of the program ends the process without waiting."""
    return any(noted_on(tree, 'ends_at_once', _mentions_exit) for tree, _ in world.files)


def _mentions_exit(tree: ast.Module) -> bool:
    attributes = (part for part in walk(tree) if isinstance(part, ast.Attribute))
    return any(part.attr in _ENDING_AT_ONCE for part in attributes)


def _is_waited_for(state: ActivityState, world: RosWorld) -> bool:
    """Whether it is a thread that is no daemon, and that the program does not join itself."""
    if state.serves or state.on_loop or state.is_daemon is not False:
        return False
    joined = [wait.client for wait in world.outside if wait.call == JOIN]
    is_joined = any(runner is each for runner in state.runners for each in joined)
    is_pool = state.kind is ActivityKind.POOL
    is_thread = state.kind is ActivityKind.THREAD and not _inherits(state, world)
    return not is_joined and (is_pool or is_thread)


def _is_chain(state: ActivityState, world: RosWorld) -> bool:
    """
    Whether it is a timer thread that arms itself forever, rclpy or no rclpy.

    ``Timer.cancel`` sets an event that is asked for once, before the function (CPython 3.12,
    ``threading.py``); and a publisher raises when rclpy is shut down, which ends the chain.
    """
    is_timer = state.kind is ActivityKind.TIMER and state.is_daemon is False
    return is_timer and not state.effects.publishes and not _inherits(state, world)


def _inherits(state: ActivityState, world: RosWorld) -> bool:
    """Whether it may be a daemon as the thread that starts it is one."""
    for start in state.starts:
        if isinstance(start.by, ActivityState) and start.by.is_daemon is not False:
            return True
        if isinstance(start.by, EntityState):
            executor = executor_of(start.by.node)
            spins = [s for s in world.spins.values() if s.executor is executor]
            if not spins or any(spin.in_thread for spin in spins):
                return True
    return False


def _stuck_blocks(
    state: ActivityState, wait: OutsideWait, world: RosWorld, spun: Sequence[Instance]
) -> Iterator[tuple[Blocking, str]]:
    """The waits that keep it, and why."""
    loops = [each for each in state.effects.blocking if each.call == WORKING_LOOP]
    for block in state.effects.blocking:
        why = why_for_ever(block, state, wait, world, spun) if block.escapes is None else None
        if why is None:
            continue
        # In a loop that asks whether to go on it stands in the wait again before it asks.
        goes_round = bool(loops) and block not in loops and way_of(block) in state.effects.looped
        is_over = may_leave(block, state, world) or is_reported(block, state, wait, world)
        goes_round = goes_round and not is_over
        is_for_good = why == NEVER_CLEARED or why.startswith(BEHIND)
        # A publisher raises when rclpy is shut down, which ends a loop.
        is_passed = block.conditional or (block in loops and state.effects.publishes)
        if comes_back(block, state, world) or goes_round or (is_for_good and not is_passed):
            yield block, _BY_HOOKS if why.startswith(BEHIND) else why


def _endless(state: ActivityState, loop: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='nobody-spins',
        place=state.place,
        message=f'the program ends only when {_who(state)} has ended; which runs a loop '
        f'({loop}) that nothing ends: the program never exits',
        help='ask for rclpy.ok() or a flag in the loop, or stop what it runs there; or '
        f'{_daemon(state)}',
    )


def _until_shutdown(state: ActivityState, loop: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='nobody-spins',
        place=state.place,
        message=f'the program ends only when {_who(state)} has ended; which runs while rclpy.ok() '
        f'({loop}), and nothing shuts rclpy down: the program never exits',
        help=f'call rclpy.shutdown() at the end of the program; or {_daemon(state)}',
    )


def _goes_on(state: ActivityState, again: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='nobody-spins',
        place=again,
        message='this timer thread is not a daemon and restarts itself in each run, and a cancel '
        'while its function runs has no effect: the program may never exit',
        help='before the restart, test a stop flag under a lock, and set it under that lock; '
        'or start it as a daemon',
    )


def _who(state: ActivityState) -> str:
    is_pool = state.kind is ActivityKind.POOL
    return 'this pool task' if is_pool else 'the non-daemon thread started here'


def _daemon(state: ActivityState) -> str:
    is_pool = state.kind is ActivityKind.POOL
    return 'run it in a daemon thread' if is_pool else 'start it with daemon=True'


def _diagnostic(state: ActivityState, block: Blocking, why: str) -> Diagnostic:
    at = f' ({block.source})' if block.source is not None else ''
    still = ' any more' if why == NOT_SPUN else ''
    call = f'a {block.call}' if block.call == WORKING_LOOP else in_words(block.call)
    help_text = _WAKE if why != _BY_HOOKS else 'end it when the spin is over, and not by `atexit`'
    return Diagnostic(
        severity=Severity.WARNING,
        slug='nobody-spins',
        place=state.place,
        message=f'the program ends only when {_who(state)} has ended; which waits in '
        f'{call} for {block.resource or "an answer"}{at}, {why}{still}: '
        'the program may never exit',
        help=f'{help_text}; or {_daemon(state)}',
    )


_BY_HOOKS = 'and only a function of `atexit` ends that, which the interpreter calls behind it'
_WAKE = (
    'wake it when the spin is over, by a last item or a flag that it asks for, or give its wait a '
    'time-out'
)
