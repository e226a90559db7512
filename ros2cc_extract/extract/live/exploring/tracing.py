"""
Stops threads at the marked instructions, and watches what they read and write there.

Only functions that hold a mark are traced, instruction by instruction; of all other code each
call costs one look into a table. Source: Python, `sys.settrace` (event `opcode`).

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from types import FrameType
from typing import Any

from ..steering.instructions import allow_instructions, has_global_lock, trace_instructions
from .control import Control
from .lost_updates import Accesses, Writers
from .marks import READ, WAIT, Mark, Marks, OfCode

Trace = Callable[[FrameType, str, Any], Any]


class Tracing:
    """
    :param report_lost: called with each lost update.
    :param everywhere: hold at every mark, also where an interpreter with its global lock would
        let no other thread in since the mark before.
    """

    def __init__(
        self,
        marks: Marks,
        control: Control,
        report_lost: Callable[..., None],
        *,
        everywhere: bool = False,
    ) -> None:
        self.marks = marks
        self.control = control
        self.everywhere = everywhere or not has_global_lock()
        self.calls = _Calls()
        self._report_lost = report_lost
        self._writers = Writers()

    def start(self) -> None:
        """Trace this thread's calls, and all threads that begin from now on."""
        allow_instructions()
        threading.settrace(self._call)
        sys.settrace(self._call)

    def stop(self) -> None:
        threading.settrace(None)
        sys.settrace(None)

    def _call(self, frame: FrameType, _event: str, _argument: Any) -> Any:
        try:
            return self._of_call(frame)
        except Exception:
            # What goes wrong here is never to reach the program.
            return None

    def _of_call(self, frame: FrameType) -> Trace | None:
        self.calls.count += 1
        of_code = self.marks.of(frame.f_code)
        if not of_code.marks:
            return None
        trace_instructions(frame)
        frame.f_trace_lines = False
        return _OfCall(of_code, self, Accesses(self._writers, self._report_lost)).trace


class _Calls(threading.local):
    """How many Python functions a thread has called: at each, another thread may come in."""

    count = 0


class _OfCall:
    """What one call of such a function does."""

    def __init__(self, of_code: OfCode, tracing: Tracing, accesses: Accesses) -> None:
        self._marks = of_code.marks
        self._switches = of_code.switches
        self._tests = of_code.tests
        self._tracing = tracing
        self._accesses = accesses
        self._done: Mark | None = None
        self._read: Mark | None = None
        self._tested: Mark | None = None
        self._at = -1
        self._calls = -1

    def trace(self, frame: FrameType, event: str, _argument: Any) -> Any:
        try:
            self._step(frame, event)
        except Exception:
            return None
        return self.trace

    def _step(self, frame: FrameType, event: str) -> None:
        if event in ('opcode', 'return') and self._done is not None:
            done, self._done = self._done, None
            self._accesses.after(done, frame)
            self._read = done if done.kind == READ else None
        if event == 'opcode':
            if self._at in self._switches:
                self._calls = -1
            self._at = frame.f_lasti
            mark = self._marks.get(frame.f_lasti)
            if mark is not None:
                self._come_to(mark, frame)
            elif frame.f_lasti in self._tests:
                self._tested, self._read = self._read or self._tested, None
            elif frame.f_lasti in self._switches:
                self._act_on_test(frame)

    def _act_on_test(self, frame: FrameType) -> None:
        """What was tested may have changed before the call to which the test has led."""
        tested, self._tested, self._read = self._tested, None, None
        if tested is not None:
            self._tracing.control.pause(tested.after_test, frame.f_code)

    def _come_to(self, mark: Mark, frame: FrameType) -> None:
        calls = self._tracing.calls.count
        self._tested = None
        may_switch = mark.kind == WAIT or calls != self._calls or self._tracing.everywhere
        if may_switch:
            self._tracing.control.pause(mark.at, frame.f_code)
            self._calls = calls
        if mark.kind != WAIT:
            self._accesses.before(mark, frame)
            self._done = mark
