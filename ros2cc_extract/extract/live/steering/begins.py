"""
Holds callbacks back where a callback group is asked whether they may begin.

What is held is refused as a closed group refuses, and asked again by the executor; so nothing is
taken that is not run, and no thread waits. Source: rclpy 7.1.6 and 9.1.2, ``executors.py``
(`_make_handler`), ``callback_groups.py``.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import functools
import sys
import threading
import time
from collections.abc import Callable
from types import FrameType
from typing import Any, Protocol

from .director import Director, is_of_program
from .plan import name_of
from .report import Report

# An executor asks at once again; without a pause it would ask all the time.
_PAUSE_S = 0.002
_EXECUTORS = 'rclpy.executors'


class Guard(Protocol):
    """Decides which callbacks begin, and is called when they do."""

    def may_begin(self, entity: Any) -> bool:
        """Whether a callback may begin now; it is asked again if not."""

    def begun(self, entity: Any) -> None:
        """Its group has let it begin, in this thread."""

    def refused(self, entity: Any) -> None:
        """It might have begun, but its group is closed."""

    def ended(self, entity: Any) -> None:
        """It has come to its end."""

    @property
    def is_open(self) -> bool:
        """Whether all threads go on as they come."""


class _Pauses:
    """
    Lets other threads come to their turn where an executor looks again and again.

    A subscription whose message is not taken yet wakes it by its QoS events as well, so that its
    wait returns at once, each time; the thread that is to take the message may then wait for the
    interpreter's lock for seconds. Source: measured, rclpy 7.1.6 with rmw_fastrtps_cpp.
    """

    def __init__(self) -> None:
        self._since = time.monotonic()

    def make(self) -> None:
        """Rest, but not more often than the executor works."""
        if time.monotonic() - self._since > _PAUSE_S:
            time.sleep(_PAUSE_S)
            self._since = time.monotonic()


def steer_groups(module: Any, guard: Guard) -> Callable[[], None]:
    """
    Wrap the methods of every class of ``rclpy.callback_groups``.

    :return: what puts them back.
    """
    wrapped: list[tuple[Any, str, Any]] = []
    pauses = _Pauses()
    for group in list(vars(module).values()):
        if isinstance(group, type) and issubclass(group, module.CallbackGroup):
            wrapped += _steer(group, guard, pauses)

    def undo() -> None:
        for group, name, original in wrapped:
            setattr(group, name, original)

    return undo


def _steer(group: Any, guard: Guard, pauses: _Pauses) -> list[tuple[Any, str, Any]]:
    names = ('can_execute', 'beginning_execution', 'ending_execution')
    can, begin, end = map(group.__dict__.get, names)
    if can is None or begin is None or end is None:
        return []

    @functools.wraps(can)
    def can_execute(self: Any, entity: Any) -> Any:
        if not guard.is_open and sys._getframe(1).f_globals.get('__name__') == _EXECUTORS:
            pauses.make()
        return can(self, entity)

    @functools.wraps(begin)
    def beginning_execution(self: Any, entity: Any) -> bool:
        if not guard.may_begin(entity):
            time.sleep(_PAUSE_S)
            return False
        accepted = bool(begin(self, entity))
        (guard.begun if accepted else guard.refused)(entity)
        return accepted

    @functools.wraps(end)
    def ending_execution(self: Any, entity: Any) -> Any:
        guard.ended(entity)
        return end(self, entity)

    wrapped = zip(names, (can_execute, beginning_execution, ending_execution), strict=True)
    for name, function in wrapped:
        setattr(group, name, function)
    return list(zip((group,) * 3, names, (can, begin, end), strict=True))


def steer_takes(executor: Any, taken: Callable[[Any], None]) -> None:
    """
    Note which entities a spin takes, in the thread that spins.

    :param executor: ``rclpy.executors.Executor``; `_make_handler(self, entity, …)`, 3.3 to 9.1.
    """
    make = executor._make_handler

    @functools.wraps(make)
    def make_handler(self: Any, entity: Any, *args: Any, **named: Any) -> Any:
        taken(entity)
        return make(self, entity, *args, **named)

    executor._make_handler = make_handler


class Running:
    """Which callbacks run in which thread, one inside the other; a director decides."""

    _of_thread = threading.local()
    is_open = True

    def __init__(self, director: Director, report: Report) -> None:
        self._director = director
        self._report = report
        self.may_begin = director.may_begin

    def begun(self, entity: Any) -> None:
        stack = self._stack()
        stack.append(id(entity))
        self._report.write('begin', **_row(entity))

    def refused(self, entity: Any) -> None:
        """It is asked for again."""

    def ended(self, entity: Any) -> None:
        stack = self._stack()
        if id(entity) in stack:
            stack.remove(id(entity))
        self._report.write('end', **_row(entity))

    def _stack(self) -> list[int]:
        if not hasattr(self._of_thread, 'stack'):
            self._of_thread.stack = []
        found: list[int] = self._of_thread.stack
        return found

    def taken(self, entity: Any) -> None:
        """A spin has taken it, to run it here or in a thread of its pool."""
        is_answer = type(entity).__name__ in ('Client', 'ActionClient')
        if not self._director.plan.points or not (is_of_program(entity) or is_answer):
            return
        found = self._director.point_of(sys._getframe(1))
        if found is not None and _is_in_callback(found[1]):
            name = f'the answer of {name_of(entity)}' if is_answer else _name(entity)
            self._director.taken_inside()
            self._report.write('nested', point=found[0], name=name)


def _is_in_callback(frame: FrameType | None) -> bool:
    """Whether an executor has called it."""
    while frame is not None:
        if frame.f_globals.get('__name__') == _EXECUTORS:
            return True
        frame = frame.f_back
    return False


def _row(entity: Any) -> dict[str, Any]:
    return {
        'entity': id(entity),
        'name': _name(entity),
        'of_program': is_of_program(entity),
        'thread': threading.get_ident(),
    }


def _name(entity: Any) -> str:
    function = getattr(entity, 'callback', None)
    return str(getattr(function, '__name__', type(entity).__name__))
