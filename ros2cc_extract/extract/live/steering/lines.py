"""
Report when a thread comes to a point of the plan, passes it, or raises there.

Only code that holds such a point is traced by line; of all other code each call costs one look
into a table. Source: Python, `sys.settrace`; the place of an instruction: PEP 657.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import inspect
import os
import sys
import threading
from types import CodeType, FrameType
from typing import Any

from .director import Director
from .instructions import allow_instructions, trace_instructions
from .plan import Point
from .races import Race, Trace
from .report import Report

_MAY_SUSPEND = inspect.CO_COROUTINE | inspect.CO_GENERATOR | inspect.CO_ASYNC_GENERATOR


class Lines:
    """
    Traces all threads that begin after ``start``, and this one.

    :param report: gets `reached`, `passed` and `raised`, with the number of the point.
    """

    def __init__(self, director: Director, report: Report) -> None:
        self._director = director
        self._report = report
        race = director.plan.race
        self._race = None if race is None else Race(race, report)
        self._points = list(enumerate(director.plan.points))
        self._known: dict[CodeType, tuple[tuple[int, Point], ...]] = {}
        self._files: dict[str, str] = {}
        self._wanted = {point.file for _, point in self._points}

    def start(self) -> None:
        if self._points:
            allow_instructions()
            threading.settrace(self._call)
            sys.settrace(self._call)

    def _call(self, frame: FrameType, event: str, _argument: Any) -> Any:
        code = frame.f_code
        found = self._known.get(code)
        if found is None:
            found = self._known[code] = self._points_in(code)
        racing = None if self._race is None else self._race.of(frame)
        if not found:
            return racing
        if any(point.column for _, point in found):
            trace_instructions(frame)
        own = _OfFrame(found, self._director, self._report).trace
        return own if racing is None else _both(own, racing)

    def _points_in(self, code: CodeType) -> tuple[tuple[int, Point], ...]:
        name = code.co_filename
        file = self._files.get(name)
        if file is None:
            file = self._files[name] = os.path.realpath(name)
        if file not in self._wanted:
            return ()
        lines = {line for _, _, line in code.co_lines() if line is not None}
        return tuple(
            (index, point)
            for index, point in self._points
            if point.file == file and point.first in lines
        )


class _OfFrame:
    """What one call of such code does."""

    def __init__(
        self, points: tuple[tuple[int, Point], ...], director: Director, report: Report
    ) -> None:
        self._points = points
        self._director = director
        self._report = report
        self._inside: set[int] = set()

    def trace(self, frame: FrameType, event: str, argument: Any) -> Any:
        if event == 'exception':
            self._raised(frame, argument)
        elif event in ('line', 'opcode', 'return'):
            for index, point in self._points:
                self._step(frame, event, index, point)
        return self.trace

    def _step(self, frame: FrameType, event: str, index: int, point: Point) -> None:
        inside = event != 'return' and point.contains(frame.f_lineno)
        if inside and index not in self._inside:
            if point.column and not _is_at(frame, event, point):
                return
            self._inside.add(index)
            self._report.write('reached', point=index, thread=threading.get_ident())
            self._director.arrive(index)
        elif index in self._inside and not inside and not self._suspends(frame, event):
            self._inside.discard(index)
            self._report.write('passed', point=index, thread=threading.get_ident())

    def _suspends(self, frame: FrameType, event: str) -> bool:
        """Whether a coroutine only gives its thread back: it stands where it stood."""
        if event != 'return' or not frame.f_code.co_flags & _MAY_SUSPEND:
            return False
        return any(point.contains(frame.f_lineno) for _, point in self._points)

    def _raised(self, frame: FrameType, argument: Any) -> None:
        kind, value = argument[0], argument[1]
        for index, point in self._points:
            if point.contains(frame.f_lineno):
                text = str(value)[:300]
                self._report.write(
                    'raised',
                    point=index,
                    thread=threading.get_ident(),
                    type=kind.__name__,
                    text=text,
                )


def _both(one: Trace, other: Trace) -> Trace:
    def trace(frame: FrameType, event: str, argument: Any) -> Any:
        one(frame, event, argument)
        other(frame, event, argument)
        return trace

    return trace


def _is_at(frame: FrameType, event: str, point: Point) -> bool:
    """Whether the next instruction is of the place in the line."""
    if event != 'opcode':
        return False
    positions = getattr(frame.f_code, 'co_positions', None)
    if positions is None:
        return True  # Python 3.10 has no positions
    for number, (line, _, column, _) in enumerate(positions()):
        if number == frame.f_lasti // 2:
            return line == point.first and column is not None and column + 1 == point.column
    return False
