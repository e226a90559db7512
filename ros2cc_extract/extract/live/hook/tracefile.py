"""
The raw trace of this process, written by the writer's thread.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. Events lie in the file as they are kept in memory (``events.py``): putting them into
words would cost the program more than all the rest of a trace. The name of a thread stands before
its first event.
"""

from __future__ import annotations

import sys
import threading
from typing import BinaryIO

from ..recorder.events import loss, thread_name, unpack


class TraceFile:
    """Opened at the first event; closed for good when it cannot be written."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._stream: BinaryIO | None = None
        self._threads: set[int] = set()
        self._usable = True

    def note_loss(self) -> None:
        """Say that events came faster than they were taken, so that the oldest are gone."""
        self._write(loss())

    def write(self, events: bytes) -> None:
        self._write(self._new_threads(events) + events)

    def _write(self, raw: bytes) -> None:
        if not self._usable:
            return
        try:
            if self._stream is None:
                self._stream = open(self._path, 'wb')  # noqa: PTH123, SIM115
            self._stream.write(raw)
            self._stream.flush()
        except OSError as error:
            self._usable = False
            # In one piece with its line end, or the program's own words may come between them.
            print(
                f'ros2cc-extract: cannot write {self._path}: {error.strerror}; the node runs on '
                'without its trace\n',
                end='',
                file=sys.stderr,
            )

    def restart(self) -> None:
        """Begin again with an empty file."""
        if self._stream is not None and self._usable:
            self._stream.close()
            self._stream = None
            self._threads.clear()

    def read(self) -> bytes:
        """
        Give what was written so far.

        :raises OSError: when it cannot be read.
        """
        if self._stream is None:
            return b''
        with open(self._path, 'rb') as stream:  # noqa: PTH123
            return stream.read()

    def close(self) -> None:
        if self._stream is not None and self._usable:
            self._usable = False
            self._stream.close()

    def _new_threads(self, events: bytes) -> bytes:
        new = {thread for _, thread, _, _ in unpack(events)} - self._threads
        if not new:
            return b''
        self._threads |= new
        names = {thread.ident: thread.name for thread in threading.enumerate()}
        return b''.join(
            thread_name(number, names.get(number) or f'thread {number}') for number in sorted(new)
        )
