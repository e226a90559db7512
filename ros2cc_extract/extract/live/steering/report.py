"""
Writes what a steered process does, one JSON object a line.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import json
import threading
import time
from typing import Any, TextIO


class Report:
    """A file that several threads write to; a line is there as soon as it is written."""

    def __init__(self, path: str) -> None:
        self._lock = threading.Lock()
        self._stream: TextIO | None = open(path, 'a', encoding='utf-8')  # noqa: PTH123, SIM115

    def write(self, what: str, **facts: Any) -> None:
        """Add a line; what cannot be written is left out, and the program goes on."""
        try:
            line = json.dumps({'what': what, 'at': time.monotonic(), **facts})
        except (TypeError, ValueError):
            return
        with self._lock:
            if self._stream is not None:
                try:
                    self._stream.write(line + '\n')
                    self._stream.flush()
                except OSError:
                    self._stream = None
