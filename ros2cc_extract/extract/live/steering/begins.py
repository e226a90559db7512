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
import os
import sys
import threading
import time
from types import FrameType
from typing import Any

from .director import Director, is_of_program
from .report import Report

# An executor asks at once again; without a pause it would ask all the time.
_PAUSE_S = 0.002


def steer_groups(module: Any, director: Director, report: Report) -> None:
    """Wrap the methods of every class of ``rclpy.callback_groups``."""
    for group in vars(module).values():
        if isinstance(group, type) and issubclass(group, module.CallbackGroup):
            _steer(group, director, report)


def _steer(group: Any, director: Director, report: Report) -> None:
    begin, end = group.__dict__.get('beginning_execution'), group.__dict__.get('ending_execution')
    if begin is None or end is None:
        return
    running = _Running(director, report)

    @functools.wraps(begin)
    def beginning_execution(self: Any, entity: Any) -> bool:
        if not director.may_begin(entity):
            time.sleep(_PAUSE_S)
            return False
        accepted = bool(begin(self, entity))
        if accepted:
            running.begin(entity)
        return accepted

    @functools.wraps(end)
    def ending_execution(self: Any, entity: Any) -> Any:
        running.end(entity)
        return end(self, entity)

    group.beginning_execution = beginning_execution
    group.ending_execution = ending_execution


class _Running:
    """Which callbacks run in which thread, one inside the other."""

    _of_thread = threading.local()

    def __init__(self, director: Director, report: Report) -> None:
        self._director = director
        self._report = report

    def begin(self, entity: Any) -> None:
        stack = self._stack()
        if stack and self._director.plan.points and is_of_program(entity):
            self._tell_nested(entity)
        stack.append(id(entity))
        self._report.write('begin', entity=id(entity), name=_name(entity))

    def end(self, entity: Any) -> None:
        stack = self._stack()
        if id(entity) in stack:
            stack.remove(id(entity))
        self._report.write('end', entity=id(entity), name=_name(entity))

    def _stack(self) -> list[int]:
        if not hasattr(self._of_thread, 'stack'):
            self._of_thread.stack = []
        found: list[int] = self._of_thread.stack
        return found

    def _tell_nested(self, entity: Any) -> None:
        frame: FrameType | None = sys._getframe(1)
        while frame is not None:
            for index, point in enumerate(self._director.plan.points):
                if point.contains(frame.f_lineno or 0) and point.file == _file_of(frame):
                    self._report.write('nested', point=index, name=_name(entity))
                    return
            frame = frame.f_back


def _file_of(frame: FrameType) -> str:
    return os.path.realpath(frame.f_code.co_filename)


def _name(entity: Any) -> str:
    function = getattr(entity, 'callback', None)
    return str(getattr(function, '__name__', type(entity).__name__))
