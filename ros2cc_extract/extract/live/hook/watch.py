"""
Notices that callbacks do not end, and writes why: the text of ``why``, once for each standstill.

Runs inside the user's process, in the thread that writes the recording: the standard library
only. What judges is loaded at a standstill, from where the tool lies; it needs nothing else
either.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import sys
import time
from collections.abc import Iterator
from typing import Any

from ..hang_analysis import probe
from ..recorder.record import Recorder
from .flight import FlightRecorder

VARIABLE = 'ROS2CC_LIVE_WATCH'
FILE_SUFFIX = '.why.txt'
# Over all callbacks, within the time limit: thousands of them take some milliseconds.
WALKS = 5
_TOOL = 'ros2cc_extract'
Run = tuple[int, int]
"""The entity, and when the run began."""


class Watch:
    """
    Asked several times a second; looks at the process when something has not ended for long.

    :param limit_s: how long that is.
    :param flight: keeps the steps that led there.
    """

    def __init__(self, recorder: Recorder, limit_s: float, flight: FlightRecorder) -> None:
        self._recorder = recorder
        self._limit_s = limit_s
        self._flight = flight
        self.forget()

    def forget(self) -> None:
        """Begin anew, as a forked child must."""
        self._ended = -1
        self._since = 0
        self._not_before = 0
        self._looked_at_timers = False
        # How old a run is to be when it is looked at again: it may come to a stop later.
        self._look_at: dict[Run, int] = {}
        #: Verdict and explanation of the standstill that goes on.
        self.standing: tuple[str, str] | None = None
        # Verdicts that were written while these ran.
        self._said: set[tuple[Run, str]] = set()

    def update(self, recording: str) -> None:
        """Look at the process if that is due; the explanation is written beside ``recording``."""
        now = time.monotonic_ns()
        if self._recorder.ended != self._ended:
            self._ended, self._since, self._looked_at_timers = self._recorder.ended, now, False
        if now < self._not_before:
            return
        limit = int(self._limit_s * 1e9)
        self._not_before, earliest = now + limit // WALKS, now - limit
        running = self._recorder.running()
        overdue = {run: now - run[1] for run in running if run[1] <= earliest}
        nothing_ended = self._since <= earliest
        self._look_at = {run: age for run, age in self._look_at.items() if run in overdue}
        if not overdue and not nothing_ended:
            self.standing = None
        due = {run for run, age in overdue.items() if age >= self._look_at.get(run, limit)}
        if due or (nothing_ended and not running and self._is_timer_due()):
            self._look_at |= {run: 2 * overdue[run] for run in due}
            self._explain(recording, set(overdue), nothing_ended=nothing_ended)

    def _is_timer_due(self) -> bool:
        """Whether a timer waits to be served; asked with success once for each standstill."""
        if not self._looked_at_timers:
            self._looked_at_timers = any(map(_is_due, self._timers()))
            return self._looked_at_timers
        return False

    def _timers(self) -> Iterator[Any]:
        for record in list(self._recorder.all_entities):
            if record.kind == 'timer' and (timer := record.ref()) is not None:
                yield timer

    def _explain(self, recording: str, overdue: set[Run], *, nothing_ended: bool) -> None:
        """Look twice, and write what is found, unless it was written before."""
        before = probe.look()
        time.sleep(probe.APART_S)
        after = probe.look()
        found = _analysis().standstill(
            os.getpid(), (before, after), self._limit_s, nothing_ended=nothing_ended
        )
        if found is None:
            return
        self.standing = verdict, text = found
        news = {(run, verdict) for run in overdue} - self._said
        if news or not overdue:
            self._said = {said for said in self._said if said[0] in overdue} | news
            _write(recording.removesuffix('.json') + FILE_SUFFIX, text)
            self._flight.keep('hang')


def _write(path: str, text: str) -> None:
    with open(path, 'a', encoding='utf-8') as stream:  # noqa: PTH123
        stream.write(text)
    if sys.stderr is not None:
        # In one piece, or the program's own words may come between the lines.
        sys.stderr.write(text)
        sys.stderr.flush()


def _is_due(timer: Any) -> bool:
    try:
        with timer.handle:
            return bool(timer.handle.is_timer_ready())
    except Exception:  # a destroyed one raises InvalidHandle, which cannot be imported here
        return False


def limit_of(text: str | None) -> float | None:
    """Read the environment variable; ``None`` where nothing is to be watched."""
    if not text:
        return None
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if 0 < seconds < float('inf'):
        return seconds
    said = f'ros2cc-extract: {VARIABLE}={text!r} is no number of seconds'
    print(f'{said}\n', end='', file=sys.stderr)
    return None


def _analysis() -> Any:
    """Load the analysis by path: the tool need not be installed for this interpreter."""
    if _TOOL not in sys.modules:
        folder = os.path.abspath(f'{__file__}/../../../..')  # noqa: PTH100
        spec = importlib.util.spec_from_file_location(
            _TOOL, f'{folder}/__init__.py', submodule_search_locations=[folder]
        )
        assert spec is not None and spec.loader is not None
        package = importlib.util.module_from_spec(spec)
        sys.modules[_TOOL] = package
        spec.loader.exec_module(package)
    return importlib.import_module(f'{_TOOL}.extract.live.hang_analysis.standstill')
