"""
What a trace adds to the recording: collecting, taking, and runs of work outside every group.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. Wrapped only when a trace is asked for.
"""

from __future__ import annotations

import functools
import time
from collections.abc import Callable
from threading import get_ident
from typing import Any

from .entries import EntityRecord, TaskRecord
from .record import COLLECT, PAUSE, RUN, TAKE, Recorder

Replace = Callable[[type, str, Any], None]


def report(recorder: Recorder, what: int, record: EntityRecord | TaskRecord) -> None:
    """Report an event that happens here and now."""
    recorder.events.append((time.monotonic_ns(), get_ident(), what, record))


def trace_takes(recorder: Recorder, executor_class: Any, replace: Replace) -> None:
    """
    Report when an executor collects a ready entity and when its data is taken.

    The only way to the take is the function that rclpy hands to ``_make_handler`` (3.3 to 9.1,
    ``executors.py``); where that is missing the trace has no such events.
    """
    original = executor_class.__dict__.get('_make_handler')
    if original is None:
        return
    entities, append, lose = recorder.entities, recorder.events.append, recorder.lose
    clock = time.monotonic_ns

    @functools.wraps(original)
    def make_handler(executor: Any, entity: Any, node: Any, take: Any, *more: Any) -> Any:
        def traced_take(taken: Any) -> Any:
            data = take(taken)
            try:
                record = entities.get(id(taken))
                if record is not None:
                    append((clock(), get_ident(), TAKE, record))
            except Exception as error:
                lose(error)
            return data

        try:
            record = entities.get(id(entity))
            if record is not None:
                append((clock(), get_ident(), COLLECT, record))
        except Exception as error:
            lose(error)
        return original(executor, entity, node, traced_take, *more)

    replace(executor_class, '_make_handler', make_handler)


def trace_runs(
    recorder: Recorder, records: dict[int, TaskRecord], task_class: Any, replace: Replace
) -> None:
    """
    Report the runs of work outside every group; a coroutine may pause and run again.

    :param records: by identity of the task, for those made by ``create_task``.
    """
    original = task_class.__dict__['__call__']
    lose = recorder.lose

    @functools.wraps(original)
    def run(task: Any) -> Any:
        record = records.get(id(task))
        if record is None:
            return original(task)
        try:
            report(recorder, RUN, record)
        except Exception as error:
            lose(error)
        try:
            return original(task)
        finally:
            try:
                report(recorder, PAUSE, record)
                if task.done():
                    records.pop(id(task), None)
            except Exception as error:
                lose(error)

    replace(task_class, '__call__', run)
