"""
Coroutines that nobody awaits, tasks that nobody keeps, and answers for which nobody waits.

Sources: CPython 3.12, library reference, *Coroutines and Tasks* (``create_task``: the loop keeps
only weak references to tasks), ``asyncio/tasks.py``, ``asyncio/base_events.py``
(``call_exception_handler``); rclpy 7.1.6 and 9.1.2, ``task.py`` (``Future.result`` gives ``None``
before the future is done).
"""

from __future__ import annotations

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.libraries.standard.asyncio_loops import LOOSE, STARTED
from ros2cc_extract.extract.static.python.machine.library_table import AWAITED
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.values.values import (
    Coroutine,
    Instance,
    Native,
    Value,
)
from ros2cc_extract.source_locations import Place


def note_discarded(world: RosWorld, value: Value, place: Place) -> None:
    """A statement does nothing with the value of its call."""
    if world.second_pass:
        return
    reported = _diagnostic(value, place)
    if reported is not None and reported not in world.diagnostics:
        world.diagnostics.append(reported)


def note_asked_at_once(world: RosWorld, future: Instance, place: Place) -> None:
    """A callback asks for the result of a request that it has just sent, and has not waited."""
    effects = world.effects
    if effects is None or world.second_pass or future.state.kind not in _OF_REQUESTS:
        return
    is_just_sent = future.born is effects and world.path == world.callback_path
    is_open = bool(effects.blocking) or id(future) in world.given
    is_open = is_open or world.is_ready(future, _DONE)
    reported = _too_early(place)
    if is_just_sent and not is_open and reported not in world.diagnostics:
        world.diagnostics.append(reported)


_OF_REQUESTS = frozenset(['client', 'goal', 'result', 'cancel'])
_DONE = frozenset([Word.SET, Word.END])


def _too_early(place: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='lost-task',
        place=place,
        message='nothing has waited for this answer since it was asked for: result() gives None',
        help='use it in a done-callback (future.add_done_callback), or await the future',
    )


def _diagnostic(value: Value, place: Place) -> Diagnostic | None:
    if isinstance(value, Coroutine):
        return _never_awaited(value.function.name, place)
    if not isinstance(value, Instance):
        return None
    if LOOSE in value.slots:
        return _never_kept(place)
    awaited = value.slots.get(AWAITED)
    if isinstance(awaited, Native) and STARTED not in value.slots:
        return _never_awaited(awaited.name, place)
    return None


def _never_awaited(name: str, place: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='lost-task',
        place=place,
        message=f'nobody awaits the coroutine {name}(): none of its code ever runs',
        help='await it',
    )


def _never_kept(place: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='lost-task',
        place=place,
        message='nobody keeps this task: an exception in it is lost, and it may be collected '
        'before it has ended',
        help='keep it and await it, or start it in an `asyncio.TaskGroup`',
    )
