"""
Report the exceptions that end a callback, a thread or the program.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import os
import sys
import threading
import traceback
from collections.abc import Callable
from typing import Any

Report = Callable[[dict[str, Any]], None]
_MOST_FRAMES = 40


class Failures:
    """
    :param report: called with the type, the text and the frames of each exception.
    """

    def __init__(self, report: Report) -> None:
        self._report = report
        self._undo: list[Callable[[], None]] = []

    def watch_threads(self) -> None:
        """Report what ends the program, or a thread of it."""
        of_program, of_threads = sys.excepthook, threading.excepthook

        def uncaught(kind: Any, error: Any, trace: Any) -> None:
            self._report(row_of(error))
            of_program(kind, error, trace)

        def uncaught_in_thread(arguments: Any) -> None:
            if arguments.exc_value is not None:
                self._report(row_of(arguments.exc_value))
            of_threads(arguments)

        sys.excepthook, threading.excepthook = uncaught, uncaught_in_thread

        def undo() -> None:
            sys.excepthook, threading.excepthook = of_program, of_threads

        self._undo.append(undo)

    def watch_callbacks(self, future: Any) -> None:
        """
        A callback that raises ends as a task that has failed (``task.py``).

        :param future: ``rclpy.task.Future``.
        """
        original = future.set_exception

        def set_exception(this: Any, error: Any) -> Any:
            self._report(row_of(error))
            return original(this, error)

        future.set_exception = set_exception
        self._undo.append(lambda: setattr(future, 'set_exception', original))

    def forget(self) -> None:
        """Put everything back."""
        while self._undo:
            self._undo.pop()()


def row_of(error: BaseException) -> dict[str, Any]:
    """Describe an exception: its type, its text, and the places of its frames."""
    frames = traceback.extract_tb(error.__traceback__)[-_MOST_FRAMES:]
    return {
        'type': type(error).__name__,
        'text': str(error)[:300],
        'frames': [[os.path.realpath(f.filename), f.lineno, f.name] for f in frames],
    }
