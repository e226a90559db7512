"""
Decide which threads go on: what ends a wait is held back until every wait has begun.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable
from types import FrameType
from typing import Any

from .plan import Plan
from .report import Report
from .surroundings import Surroundings

# For the first arrival: an import of a large package and the discovery of DDS take seconds.
_FIRST_S = 15.0
_SOFT_S = 3.0
# For the first look of a nested spin, on a busy machine.
_INSIDE_FIRST_S = 0.5


class Director:
    """
    Knows which points are reached.

    Nothing is held forever: after the time of the plan everything is let go, and it is written
    which point was not reached.
    """

    def __init__(self, plan: Plan, report: Report) -> None:
        self.plan = plan
        self._report = report
        self._changed = threading.Condition(threading.Lock())
        self._missing = [point.count for point in plan.points]
        self._arrived: set[tuple[int, int]] = set()
        self._give_up_at = time.monotonic() + _FIRST_S
        self.is_open = not plan.points
        self._inside_until = 0.0
        #: Called once, before the first arrival.
        self.prepare: Callable[[], None] | None = None
        self._surroundings = Surroundings(plan.surroundings)

    def may_begin(self, entity: Any) -> bool:
        """Whether a callback may begin now; it is asked again if not."""
        if not self._is_ready() and is_of_program(entity):
            return False
        if self.is_open:
            return time.monotonic() > self._inside_until or not self._is_for_inside(entity)
        held = [each for each in self.plan.held if each.is_of(entity)]
        self.look_at_the_clock()
        return self.is_open or not held or (self._is_late() and all(each.soft for each in held))

    def _is_for_inside(self, entity: Any) -> bool:
        """Whether the nested spin takes it first, and not the spin around it."""
        held = any(each.is_of(entity) for each in self.plan.held)
        return held and self.point_of(sys._getframe(2)) is None

    def taken_inside(self) -> None:
        """The nested spin has taken something: all others may, too."""
        self._inside_until = 0.0

    def _is_ready(self) -> bool:
        """Whether what the node meets is there; only then may threads be given up."""
        if self._surroundings.ready_since is None and self._surroundings.are_ready():
            self._give_up_at = max(self._give_up_at, time.monotonic() + _FIRST_S)
        return self._surroundings.ready_since is not None

    def _is_late(self) -> bool:
        since = self._surroundings.ready_since
        return since is not None and time.monotonic() - since > _SOFT_S

    def arrive(self, index: int) -> None:
        """Note that this thread stands at a point; where the plan says so, wait for the rest."""
        self._prepare()
        self._pause(index)
        with self._changed:
            mark = index, threading.get_ident()
            if not self.is_open and mark not in self._arrived:
                self._arrived.add(mark)
                if len(self._arrived) == 1:
                    self._give_up_at = time.monotonic() + self.plan.patience_s
                self._missing[index] -= 1
                if not any(count > 0 for count in self._missing):
                    self._open(given_up=False)
            while not self.is_open and self.plan.points[index].holds:
                left_s = self._give_up_at - time.monotonic()
                if left_s <= 0 or not self._changed.wait(left_s):
                    self._open(given_up=True)

    def _prepare(self) -> None:
        with self._changed:
            prepare, self.prepare = self.prepare, None
            if prepare is not None:
                prepare()

    def point_of(self, frame: FrameType | None) -> tuple[int, FrameType] | None:
        """Which point a call, or one that led to it, stands at, and which of them does."""
        while frame is not None:
            for index, point in enumerate(self.plan.points):
                if point.contains(frame.f_lineno or 0) and point.file == _file_of(frame):
                    return index, frame
            frame = frame.f_back
        return None

    def _pause(self, index: int) -> None:
        """The first one only: others get going meanwhile."""
        point = self.plan.points[index]
        seconds, point.pause_s = point.pause_s, 0.0
        if seconds:
            time.sleep(seconds)

    def look_at_the_clock(self) -> None:
        """Let everything go when the time is over."""
        if not self.is_open and time.monotonic() > self._give_up_at:
            with self._changed:
                self._open(given_up=True)

    def _open(self, *, given_up: bool) -> None:
        if not self.is_open:
            self.is_open = True
            if self.plan.inside and not given_up:
                self._inside_until = time.monotonic() + _INSIDE_FIRST_S
            missing = [index for index, count in enumerate(self._missing) if count > 0]
            self._report.write('open', given_up=given_up, missing=missing)
            self._changed.notify_all()


def _file_of(frame: FrameType) -> str:
    return os.path.realpath(frame.f_code.co_filename)


def is_of_program(entity: Any) -> bool:
    """Whether the program has written what it runs; a server of actions runs what it has."""
    if type(entity).__name__ == 'ActionServer':
        return True
    function = getattr(entity, 'callback', None)
    module = str(getattr(function, '__module__', '') or 'rclpy')
    return module.partition('.')[0] != 'rclpy'
