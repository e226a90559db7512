"""Schedules within this process: for tests that spin an executor themselves."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

from ros2cc_extract.confirm.observations import Sample, sample_of
from ros2cc_extract.explore.failures import Failure, exception, hang, lost_update
from ros2cc_extract.explore.points import Point
from ros2cc_extract.explore.scenario import Row
from ros2cc_extract.extract.live.exploring.activities import label_of
from ros2cc_extract.extract.live.exploring.conductor import (
    TICK_S,
    Conductor,
    Limits,
    look_twice,
)
from ros2cc_extract.extract.live.exploring.control import Control
from ros2cc_extract.extract.live.exploring.exploration import file_of, lost_row
from ros2cc_extract.extract.live.exploring.marks import Mark, Marks
from ros2cc_extract.extract.live.exploring.marks import Point as LivePoint
from ros2cc_extract.extract.live.exploring.tracing import Tracing
from ros2cc_extract.extract.live.steering.begins import steer_groups
from ros2cc_extract.extract.live.steering.failures import Failures

STILL_S = 1.5
"""Nothing has begun or ended for so long: time to look."""


class Learned:
    """
    What one run has shown of the program, for the next.

    :param files: in which the functions of callbacks stand.
    :param labels: names of the callbacks that have begun.
    """

    def __init__(self) -> None:
        self.files: dict[str, None] = {}
        self.labels: dict[str, None] = {}

    def note(self, entity: Any) -> None:
        self.labels[label_of(entity)] = None
        file = file_of(entity)
        if file:
            self.files[file] = None


class InProcess:
    """
    One schedule of this process: what is wrapped, and what went wrong.

    :param hung: called when a hang is found, from a thread of ours.
    """

    def __init__(
        self,
        points: Sequence[Point],
        learned: Learned,
        hung: Callable[[Failure], None] = lambda failure: None,
    ) -> None:
        self.failures: list[Failure] = []
        self._hung = hung
        self._control = Control(learned.note, learned.labels, refuses=False)
        self._conductor = Conductor(self._control, lambda what, **facts: None, Limits({}))
        self._errors = Failures(self._failed)
        marks = Marks([LivePoint(asdict(each)) for each in points])
        self._tracing = Tracing(marks, self._control, self._lost) if points else None
        self._unwrap: Callable[[], None] = lambda: None
        self._traced_before: tuple[Any, Any] = (None, None)
        self._is_over = threading.Event()

    @property
    def choices(self) -> list[tuple[str, str]]:
        """The chosen threads, and where each stood."""
        return list(self._control.choices)

    @property
    def begins(self) -> int:
        return self._control.begins

    def install(self) -> None:
        """Wrap rclpy, which is loaded, and trace the threads that begin from now on."""
        self._unwrap = steer_groups(sys.modules['rclpy.callback_groups'], self._control)
        self._errors.watch_callbacks(sys.modules['rclpy.task'].Future)
        if self._tracing is not None:
            self._traced_before = sys.gettrace(), threading.gettrace()
            self._tracing.start()

    def uninstall(self) -> None:
        """Put everything back."""
        self.end()
        self._unwrap()
        self._errors.forget()
        if self._tracing is not None:
            sys.settrace(self._traced_before[0])
            threading.settrace(self._traced_before[1])

    def begin(self, row: Row) -> None:
        """
        Take control, as the schedule says.

        :raises KeyError, ValueError, TypeError: if the row is invalid.
        """
        self._conductor.begin(dict(row))
        threading.Thread(target=self._tick, name='ros2cc schedules', daemon=True).start()

    def end(self) -> None:
        """Let all threads go on."""
        self._is_over.set()
        self._control.let_go()

    def _tick(self) -> None:
        sys.settrace(None)  # this thread is not of the program
        samples: list[Sample] = []
        while not self._is_over.wait(TICK_S):
            if self._control.is_over:
                self._control.let_go()
            self._control.look_at_the_clock()
            now = time.monotonic()
            if now - self._control.moved_at < STILL_S:
                samples.clear()
            elif not samples or now - samples[-1].at > 1.0:
                samples.append(sample_of(os.getpid(), {'at': now, 'looks': _looks()}))
                found = hang(samples)
                if found is not None:
                    self.failures.append(found)
                    self._hung(found)
                    return

    def _failed(self, row: dict[str, Any]) -> None:
        found = exception({**row, **self._conductor.so_far()})
        if found is not None:
            self.failures.append(found)

    def _lost(self, mark: Mark, **values: Any) -> None:
        self.failures.append(lost_update(lost_row(mark, self._conductor, values)))


def _looks() -> list[dict[str, Any]]:
    """Two looks, without the frames of the test runner: they are many, and hold nothing."""
    looks = look_twice()
    for look in looks:
        for thread in look['threads']:
            own = [each for each in thread['frames'] if not _is_of_runner(each)]
            thread['frames'] = own or thread['frames'][-1:]
    return looks


def _is_of_runner(frame: dict[str, Any]) -> bool:
    return str(frame['module']).partition('.')[0] in ('_pytest', 'pytest', 'pluggy')
