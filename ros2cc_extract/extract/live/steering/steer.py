"""
Steers this process where the environment asks for it, and looks at it again and again.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import time

from ..hang_analysis import probe
from .begins import Running, steer_groups, steer_takes
from .destroys import Destroys
from .director import Director
from .failures import Failures
from .lines import Lines
from .loops import asleep
from .plan import STUBS_VARIABLE, VARIABLE, read_plan
from .report import Report
from .stand_ins.stubs import handed, offer_stubs

LOOKS_EVERY_S = 1.0


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
        self._parent = os.getppid()
        Lines(director, report).start()
        self._failures = Failures(lambda row: report.write('failed', **row))
        self._failures.watch_threads()
        report.write('started', process=os.getpid())

    def wrap(self) -> None:
        """Wrap what is loaded of rclpy, and begin to look."""
        running = Running(self._director, self._report)
        steer_takes(sys.modules['rclpy.executors'].Executor, running.taken)
        steer_groups(sys.modules['rclpy.callback_groups'], running)
        if self._director.plan.destroys:
            # Only when it is needed: the module of nodes is loaded later.
            self._director.prepare = Destroys(self._director, self._report).wrap
        self._failures.watch_callbacks(sys.modules['rclpy.task'].Future)
        threading.Thread(target=self._look, name='ros2cc looks', daemon=True).start()

    def _look(self) -> None:
        while True:
            time.sleep(LOOKS_EVERY_S)
            if os.getppid() != self._parent:
                # The watching process was killed: nothing else would end this one.
                os.kill(os.getpid(), signal.SIGKILL)
            self._director.look_at_the_clock()
            if 'asyncio' in sys.modules:
                self._report.write('asleep', loops=asleep())
            if handed:
                self._report.write('handed', functions=sorted(handed))
            if self._director.is_open:
                try:
                    looks = [probe.look()]
                    time.sleep(probe.APART_S)
                    looks.append(probe.look())
                except Exception as error:
                    self._report.write('blind', text=repr(error)[:300])
                else:
                    self._report.write('looks', looks=looks)
