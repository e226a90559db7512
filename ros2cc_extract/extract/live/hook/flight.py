"""
The flight recorder: the steps of the last half minute, in two files that take turns.

Runs inside the user's process, in the thread that writes the recording: the standard library
only. The files are on disk before anything goes wrong, so a process that is killed leaves them
too. At a hang, an exception or a signal they are copied under a name that says so.
"""

from __future__ import annotations

import faulthandler
import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from ..recorder.events import RAW_SUFFIX, pack
from ..recorder.record import Recorder
from .tracefile import TraceFile

KEPT_S = 30.0
SIGNAL = signal.SIGUSR2
# The two files, after the name of the recording without its suffix.
TURNS = ('.flight-a', '.flight-b')
# What a copy is called: the same, ``-``, why, ``-``, its number, and the suffix of raw events.
COPY = '.kept-'
# A process that hangs again and again does not fill the disk.
MOST_COPIES = 20
_ENDS_OF_PROGRAMS = ('KeyboardInterrupt', 'SystemExit', 'ExternalShutdownException')


class FlightRecorder:
    """
    Keeps the events of at least the last ``KEPT_S`` seconds, at most of twice as long.

    A callback that began before that and still runs keeps its begin.
    """

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self._asked_fd: int | None = None
        self._exception = False

    def begin(self, recording: str) -> None:
        """Start anew beside the recording of this process, as a forked child must."""
        self._stem = recording.removesuffix('.json')
        self._files = [TraceFile(f'{self._stem}{turn}') for turn in TURNS]
        self._turn_at = 0.0
        self._copies = 0
        self._asked = 0
        self._asked_fd = None
        self._exception = False

    def listen(self) -> None:
        """
        Notice the signal and exceptions of threads from now on.

        The handler is ``faulthandler``'s, in C: it needs neither the main thread nor the
        interpreter lock. It writes into memory, and that it has done so is looked at later.
        """
        if signal.getsignal(SIGNAL) == signal.SIG_DFL and self._asked_fd is None:
            self._asked_fd = os.memfd_create('ros2cc-extract')
            faulthandler.register(SIGNAL, self._asked_fd, all_threads=False)
        threading.excepthook = self._noticing(threading.excepthook)

    def write(self, events: bytes) -> None:
        """Write events; the older file is begun anew when the newer one is full."""
        now = time.monotonic()
        if now >= self._turn_at:
            self._turn_at = now + KEPT_S
            self._files.reverse()
            self._files[0].restart()
            events = b''.join(pack(*run) for run in self._recorder.open_runs(events)) + events
        if events:
            self._files[0].write(events)

    def update(self) -> None:
        """Keep what there is if the signal or an exception has come since the last time."""
        if self._asked_fd is not None:
            asked = os.fstat(self._asked_fd).st_size
            if asked != self._asked:
                self._asked = asked
                self.keep('signal')
        if self._exception:
            self._exception = False
            self.keep('exception')

    def keep(self, why: str) -> None:
        """
        Copy the events under a name of their own, and say so.

        :param why: *hang*, *exception* or *signal*, a part of the name.
        """
        if self._copies >= MOST_COPIES:
            return
        self._copies += 1
        path = f'{self._stem}{COPY}{why}-{self._copies}{RAW_SUFFIX}'
        try:
            raw = b''.join(file.read() for file in reversed(self._files))
            with open(path, 'wb') as stream:  # noqa: PTH123
                stream.write(raw)
        except OSError as error:
            self._say(f'the last steps before the {why} cannot be kept: {error.strerror}')
        else:
            folder = os.path.dirname(path)  # noqa: PTH120
            self._say(f'the last steps before the {why} are kept in {folder}')

    def finish(self) -> None:
        """The program ends: keep the steps if an exception ended it."""
        ended_by = getattr(sys, 'last_value', None)
        if self._exception or (ended_by is not None and _is_failure(type(ended_by))):
            self.keep('exception')

    def _noticing(self, before: Callable[[Any], Any]) -> Callable[[Any], Any]:
        def excepthook(args: Any) -> Any:
            # Kept by the writer's thread, which has the steps up to now.
            self._exception = self._exception or _is_failure(args.exc_type)
            return before(args)

        return excepthook

    @staticmethod
    def _say(text: str) -> None:
        if sys.stderr is not None:
            print(f'ros2cc-extract: {text}\n', end='', file=sys.stderr)


def _is_failure(exception: type[BaseException]) -> bool:
    return exception.__name__ not in _ENDS_OF_PROGRAMS
