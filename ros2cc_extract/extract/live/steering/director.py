"""
Decides who may go on: what ends a wait is held back until every wait has begun.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import threading
import time
from typing import Any

from .plan import Plan
from .report import Report

# For the first arrival: an import of a large package and the discovery of DDS take seconds.
_FIRST_S = 15.0


class Director:
    """
    Knows which points are reached.

    Nothing is held for ever: after the time of the plan everything is let go, and it is written
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

    def may_begin(self, entity: Any) -> bool:
        """Whether a callback may begin now; it is asked again if not."""
        if self.is_open or not any(each.is_of(entity) for each in self.plan.held):
            return True
        self.look_at_the_clock()
        return self.is_open

    def arrive(self, index: int) -> None:
        """Note that this thread stands at a point; where the plan says so, wait for the rest."""
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

    def look_at_the_clock(self) -> None:
        """Let everything go when the time is over."""
        if not self.is_open and time.monotonic() > self._give_up_at:
            with self._changed:
                self._open(given_up=True)

    def _open(self, *, given_up: bool) -> None:
        if not self.is_open:
            self.is_open = True
            missing = [index for index, count in enumerate(self._missing) if count > 0]
            self._report.write('open', given_up=given_up, missing=missing)
            self._changed.notify_all()
