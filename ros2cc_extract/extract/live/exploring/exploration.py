"""
Explores the schedules of this process where the environment asks for it.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
import time
from typing import Any

from ..steering.begins import steer_groups
from ..steering.failures import Failures
from ..steering.plan import STUBS_VARIABLE
from ..steering.report import Report
from ..steering.stand_ins.stubs import offer_stubs
from ..steering.surroundings import Surroundings
from .activities import label_of
from .conductor import Conductor, Limits, conducted
from .control import Control
from .marks import Mark, Marks, Point
from .tracing import Tracing

VARIABLE = 'ROS2CC_LIVE_EXPLORE'
CLAIMED = '.claimed'
"""Behind the name of a report: the process that writes it is there."""


def explore_from_environment() -> Exploration | None:
    """
    Begin where a plan is named.

    The first process that loads rclpy's executors is explored; what only leads there, as
    ``ros2 run``, and what is started beside it, is not.
    """
    path = os.environ.get(VARIABLE)
    if path is None:
        return None
    if os.environ.get(STUBS_VARIABLE) == '1':
        offer_stubs()
    with open(path, encoding='utf-8') as stream:  # noqa: PTH123
        return Exploration(json.load(stream))


class Exploration:
    """
    :param plan: `report`, `surroundings`, `points`, `everywhere` (hold at all of them, see
        ``Tracing``), `limits`, `schedules`, and `watcher`, the process that is to be outlived by
        nobody.
    """

    def __init__(self, plan: dict[str, Any]) -> None:
        self._plan = plan

    def wrap(self) -> None:
        """Wrap what is loaded of rclpy, and begin with the first schedule."""
        try:
            with open(self._plan['report'] + CLAIMED, 'x', encoding='utf-8'):  # noqa: PTH123
                pass
        except FileExistsError:
            return
        report = Report(self._plan['report'])
        report.write('started', process=os.getpid())
        reported: set[str] = set()

        def report_begun(entity: Any) -> None:
            label = label_of(entity)
            if label not in reported:
                reported.add(label)
                report.write('callback', label=label, file=file_of(entity))

        control = Control(report_begun, map(str, self._plan.get('known', ())))
        conductor = Conductor(control, report.write, Limits(self._plan.get('limits', {})))

        def report_lost(mark: Mark, **values: Any) -> None:
            report.write('lost', **lost_row(mark, conductor, values))

        def report_failed(row: dict[str, Any]) -> None:
            report.write('failed', **conductor.so_far(), **row)

        failures = Failures(report_failed)
        failures.watch_threads()
        failures.watch_callbacks(sys.modules['rclpy.task'].Future)
        steer_groups(sys.modules['rclpy.callback_groups'], control)
        points = [Point(each) for each in self._plan.get('points', ())]
        if points:
            everywhere = bool(self._plan.get('everywhere', False))
            Tracing(Marks(points), control, report_lost, everywhere=everywhere).start()

        def run() -> None:
            conductor.wait_for(Surroundings(str(self._plan.get('surroundings', ''))))
            for row in self._plan['schedules']:
                conductor.run(row)
            report.write('finished')

        control.hold_all()
        conducted(control, conductor, run)
        watcher = int(self._plan.get('watcher', 0))
        threading.Thread(target=_end_with, args=(watcher,), daemon=True).start()


def lost_row(mark: Mark, conductor: Conductor, values: dict[str, Any]) -> dict[str, Any]:
    """Describe a lost update."""
    return {
        **conductor.so_far(),
        'file': mark.file,
        'line': mark.line,
        'name': mark.name,
        **values,
    }


def _end_with(watcher: int) -> None:
    """End with the watching process: if that was killed, nothing else would end this one."""
    while watcher:
        time.sleep(1.0)
        try:
            os.kill(watcher, 0)
        except OSError:
            os.kill(os.getpid(), signal.SIGKILL)


def file_of(entity: Any) -> str:
    """In which file the function of a callback stands; empty where that is not known."""
    function = getattr(entity, 'callback', None)
    function = getattr(function, 'func', function)
    code = getattr(getattr(function, '__func__', function), '__code__', None)
    return os.path.realpath(code.co_filename) if code is not None else ''
