"""
The thread that keeps the file of this process up to date.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
import time
from collections.abc import Callable

from ..recorder.events import RAW_SUFFIX
from ..recorder.record import EVENTS_KEPT, Recorder
from ..recorder.snapshot import snapshot
from ..recorder.spinning import look_for_spinning_threads
from .diagnostics import Diagnostics
from .flight import FlightRecorder
from .tracefile import TraceFile
from .watch import Watch

# The file is at most 0.5 s old: something new is written at once, mere counts every other time.
INTERVAL_S = 0.24
# Writing mere counts takes at most this share of one processor, however much there is to write.
LARGEST_SHARE = 0.02
RETRY_S = 5.0
# Long enough that a thread that waits for the interpreter gets it.
PAUSE_S = 0.0001


class Writer:
    """Rewrites one file, by way of a temporary one, whenever the recorder has changed."""

    def __init__(
        self,
        recorder: Recorder,
        path: Callable[[], str],
        *,
        traced: bool = False,
        watch: Watch | None = None,
        flight: FlightRecorder | None = None,
        diagnostics: Diagnostics | None = None,
    ) -> None:
        self._recorder = recorder
        self._path_of_process = path
        self._traced = traced
        self._watch = watch
        self._flight = flight
        self._diagnostics = diagnostics
        self.forget()

    def forget(self) -> None:
        """Begin anew, as a forked child must: its parent's thread does not exist there."""
        self._path = self._path_of_process()
        self._trace = TraceFile(f'{self._path}{RAW_SUFFIX}') if self._traced else None
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self._looked_changes = 0
        self._written_changes = (0, 0)
        self._counts_not_before = 0.0
        self._not_before = 0.0
        self._counts_turn = False
        self._complained = False
        if self._watch is not None:
            self._watch.forget()
        if self._flight is not None:
            self._flight.begin(self._path)
        if self._diagnostics is not None:
            self._diagnostics.forget()

    def start(self) -> None:
        """Start the thread, unless it runs."""
        if self._thread is None:
            if self._flight is not None:
                self._flight.listen()
            self._thread = threading.Thread(target=self._run, name='ros2cc-extract', daemon=True)
            self._thread.start()

    def finish(self) -> None:
        """Write what there is, for the last time."""
        self._stop.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(timeout=2.0)
        if self._recorder.all_executors or self._recorder.loss_count:
            self.take_events()
            if self._flight is not None:
                self._flight.finish()
            self._recorder.settle()
            self._write(ended=True)
        if self._trace is not None:
            self._trace.close()

    def _run(self) -> None:
        # No signal is to be delivered here that the program awaits in a thread of its own.
        signal.pthread_sigmask(signal.SIG_BLOCK, signal.valid_signals())
        while not self._stop.wait(INTERVAL_S):
            try:
                self.update()
                if self._flight is not None:
                    self._flight.update()
                if self._watch is not None:
                    self._watch.update(self._path)
                    if self._diagnostics is not None:
                        self._diagnostics.update(self._watch.standing)
            except Exception as error:
                self._recorder.lose(error)

    def update(self) -> None:
        """Write the file if anything has changed since it was written."""
        recorder = self._recorder
        self.take_events()
        if recorder.changes != self._looked_changes:
            self._looked_changes = recorder.changes
            recorder.look_around()
            recorder.settle()
        look_for_spinning_threads(recorder)
        changes = recorder.changes, recorder.measured
        is_new = changes[0] != self._written_changes[0]
        is_turn = self._counts_turn = not self._counts_turn
        if not is_new and not (is_turn and changes != self._written_changes):
            return
        if time.monotonic() >= (self._not_before if is_new else self._counts_not_before):
            self._written_changes = changes
            self._rewrite()

    def _rewrite(self) -> None:
        started_at, started = time.monotonic(), time.thread_time()
        done = self._write(ended=False)
        spent = time.thread_time() - started
        self._not_before = time.monotonic() + (0.0 if done else RETRY_S)
        self._counts_not_before = max(self._not_before, started_at + spent / LARGEST_SHARE)

    def take_events(self) -> None:
        """Account for what has happened since the last time."""
        overflowed = len(self._recorder.journal) >= EVENTS_KEPT
        if self._trace is not None and overflowed:
            self._trace.note_loss()
        while events := self._recorder.take_events():
            if self._trace is not None:
                self._trace.write(events)
            if self._flight is not None:
                self._flight.write(events)
            # A thread with something to do would else wait for the last batch, or for 5 ms.
            time.sleep(PAUSE_S)

    def _write(self, *, ended: bool) -> bool:
        with self._recorder.lock:
            text = snapshot(self._recorder, ended=ended)
        path = self._path
        temporary = f'{path}.new'
        try:
            with open(temporary, 'w', encoding='utf-8') as stream:  # noqa: PTH123
                stream.write(text)
            os.replace(temporary, path)  # noqa: PTH105
        except OSError as error:
            self._complain(path, error)
            with contextlib.suppress(OSError):
                os.unlink(temporary)  # noqa: PTH108
            return False
        return True

    def _complain(self, path: str, error: OSError) -> None:
        if not self._complained:
            self._complained = True
            # In one piece with its line end, or the program's own words may come between them.
            print(
                f'ros2cc-extract: cannot write {path}: {error.strerror}; the node runs on, '
                'its recording is tried again every 5 s\n',
                end='',
                file=sys.stderr,
            )
