"""
Which thread spins an executor, and by which function: read from the stacks of all threads.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. Looking at stacks from another thread disturbs nothing.
"""

from __future__ import annotations

import sys
import threading
from types import FrameType

from .entries import ExecutorRecord
from .record import Recorder

_SPIN_FUNCTIONS = ('spin', 'spin_once', 'spin_until_future_complete')


def look_for_spinning_threads(recorder: Recorder) -> None:
    """Note for executors not yet seen spinning how and where they are spun."""
    missing = {id(record.ref()): record for record in recorder.all_executors if not record.spun}
    if not missing:
        return
    main = threading.main_thread().ident
    for thread, frame in sys._current_frames().items():
        record, spun = _spun_by(frame, missing)
        if record is not None:
            record.spun, record.in_thread = spun, thread != main
            recorder.changes += 1


def _spun_by(
    frame: FrameType | None, missing: dict[int, ExecutorRecord]
) -> tuple[ExecutorRecord | None, str | None]:
    """Find the executor that waits in this stack and its outermost spinning function."""
    record, spun = None, None
    while frame is not None:
        module = frame.f_globals.get('__name__', '')
        function = frame.f_code.co_name
        if record is None and function == 'wait_for_ready_callbacks':
            record = missing.get(id(frame.f_locals.get('self')))
        elif record is not None and function in _SPIN_FUNCTIONS:
            if module == 'rclpy':
                spun = f'rclpy.{function}'
            elif module.startswith('rclpy.'):
                spun = f'executor.{function}'
        frame = frame.f_back
    return record, spun
