"""
The trace of this process: one line of JSON for each event, written by the writer's thread.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. A line is ``[clock_ns, thread, event, number]``; the numbers are those of the
recording, thread names are told by ``["thread", number, name]`` before their first event, and
``["lost"]`` says that events came faster than they could be kept.
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Sequence
from typing import TextIO

from .record import EVENT_NAMES, Event


class TraceFile:
    """Opened at the first event; closed for good when it cannot be written."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._stream: TextIO | None = None
        self._threads: set[int] = set()
        self._usable = True

    def note_loss(self) -> None:
        """Say that events came faster than they were taken, so that the oldest are gone."""
        self._write('["lost"]\n')

    def write(self, events: Sequence[Event]) -> None:
        lines = self._new_threads(events)
        lines += [
            f'[{clock},{thread},"{EVENT_NAMES[what]}",{record.number}]\n'
            for clock, thread, what, record in events
        ]
        self._write(''.join(lines))

    def _write(self, text: str) -> None:
        if not self._usable:
            return
        try:
            if self._stream is None:
                self._stream = open(self._path, 'w', encoding='utf-8')  # noqa: PTH123, SIM115
            self._stream.write(text)
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

    def close(self) -> None:
        if self._stream is not None and self._usable:
            self._usable = False
            self._stream.close()

    def _new_threads(self, events: Sequence[Event]) -> list[str]:
        new = {event[1] for event in events} - self._threads
        if not new:
            return []
        self._threads |= new
        names = {thread.ident: thread.name for thread in threading.enumerate()}
        return [
            f'["thread",{number},{json.dumps(names.get(number) or f"thread {number}")}]\n'
            for number in sorted(new)
        ]
