"""
Steers this process where the environment asks for it, and looks at it again and again.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import os
import sys
import threading
import time
import traceback
from typing import Any

from ..hang_analysis import probe
from .begins import steer_groups
from .director import Director
from .lines import Lines
from .plan import STUBS_VARIABLE, VARIABLE, read_plan
from .report import Report
from .stubs import offer_stubs

LOOKS_EVERY_S = 1.0
_MOST_FRAMES = 40


def steer_from_environment() -> Steering | None:
    """Begin where a plan is named; processes that are started from here are not steered."""
    path = os.environ.pop(VARIABLE, None)
    if path is None:
        return None
    if os.environ.pop(STUBS_VARIABLE, '0') == '1':
        offer_stubs()
    plan = read_plan(path)
    report = Report(plan.report)
    return Steering(Director(plan, report), report)


class Steering:
    """Waits for rclpy to be loaded, and reports how it goes."""

    def __init__(self, director: Director, report: Report) -> None:
        self._director = director
        self._report = report
        Lines(director, report).start()
        self._excepthook, sys.excepthook = sys.excepthook, self._uncaught
        self._thread_hook, threading.excepthook = threading.excepthook, self._uncaught_in_thread
        report.write('started', process=os.getpid())

    def wrap(self) -> None:
        """Wrap what is loaded of rclpy, and begin to look."""
        steer_groups(sys.modules['rclpy.callback_groups'], self._director, self._report)
        self._wrap_failures(sys.modules['rclpy.task'].Future)
        threading.Thread(target=self._look, name='ros2cc looks', daemon=True).start()

    def _wrap_failures(self, future: Any) -> None:
        """A callback that raises ends as a task that has failed (``task.py``)."""
        original = future.set_exception

        def set_exception(this: Any, error: Any) -> Any:
            self._tell(error)
            return original(this, error)

        future.set_exception = set_exception

    def _look(self) -> None:
        while True:
            time.sleep(LOOKS_EVERY_S)
            self._director.look_at_the_clock()
            if self._director.is_open:
                try:
                    looks = [probe.look()]
                    time.sleep(probe.APART_S)
                    looks.append(probe.look())
                except Exception as error:
                    self._report.write('blind', text=repr(error)[:300])
                else:
                    self._report.write('looks', looks=looks)

    def _uncaught(self, kind: Any, error: Any, trace: Any) -> None:
        self._tell(error)
        self._excepthook(kind, error, trace)

    def _uncaught_in_thread(self, arguments: Any) -> None:
        self._tell(arguments.exc_value)
        self._thread_hook(arguments)

    def _tell(self, error: Any) -> None:
        frames = traceback.extract_tb(error.__traceback__)[-_MOST_FRAMES:]
        self._report.write(
            'failed',
            type=type(error).__name__,
            text=str(error)[:300],
            frames=[[os.path.realpath(f.filename), f.lineno, f.name] for f in frames],
        )
