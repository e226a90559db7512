"""
What a trace adds to the recording: waiting, collecting, handing to the pool, taking, pausing.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. Wrapped only when a trace is asked for.
"""

from __future__ import annotations

import functools
import inspect
import sys
import time
import weakref
from collections.abc import Callable
from threading import get_ident
from types import CodeType, FrameType
from typing import Any

from ..recorder.entries import TaskRecord
from ..recorder.events import (
    COLLECT,
    PAUSE,
    RESUME,
    RUN,
    SUBMIT,
    SUSPEND,
    TAKE,
    TASK,
    VAIN,
    WAIT,
    WOKEN,
)
from ..recorder.journal import native
from ..recorder.record import Recorder

Replace = Callable[[type, str, Any], None]
# What we keep with each task of rclpy; these are the values of one not yet seen.
_KEPT_WITH_TASKS = {
    '_ros2cc_record': None,
    '_ros2cc_submitted': False,
    '_ros2cc_suspended': False,
    '_ros2cc_resumed': False,
    '_ros2cc_awaited': None,
    '_ros2cc_over': False,
}
_clock = time.monotonic_ns


def report(recorder: Recorder, what: int, record: Any) -> None:
    """Report an event that happens here and now."""
    recorder.journal.note(what, record.number)


def trace_waits(recorder: Recorder, executors: Any, replace: Replace) -> None:
    """
    Report when an executor begins to wait for work and when it is woken.

    It waits in the ``WaitSet`` that a generator builds on every lap, and that generator is asked
    by ``wait_for_ready_callbacks``, whose ``self`` it is (3.3 to 9.1, ``executors.py``). Reading
    that from its frame costs less than a wrapper, which would be called for every callback; the
    only executor of a program need not even be read.
    """
    lap = executors.Executor._wait_for_ready_callbacks.__code__
    wait = executors._rclpy.WaitSet.wait

    def asker(caller: FrameType) -> Any:
        asked_by = caller.f_back
        executor = asked_by.f_locals.get('self') if asked_by is not None else None
        return recorder.executors.get(id(executor))

    if native is None:
        traced = _plain_wait(recorder, wait, lap, asker)
    else:
        journal, lose = recorder.journal, recorder.lose
        traced = native.wait_method(wait, WAIT, WOKEN, journal, recorder, lap, asker, lose)
    replace(executors._rclpy.WaitSet, 'wait', functools.update_wrapper(traced, wait))


def _plain_wait(recorder: Recorder, wait: Any, lap: CodeType, asker: Any) -> Any:
    note, lose = recorder.journal.note, recorder.lose

    def traced_wait(*args: Any, **named: Any) -> Any:
        reported = None
        try:
            caller = sys._getframe(1)
            record = None
            if caller.f_code is lap:
                record = recorder.only_executor or asker(caller)
            if record is not None:
                number = record.number
                note(WAIT, number)
                reported = number
        except Exception as error:
            lose(error)
        try:
            return wait(*args, **named)
        finally:
            try:
                if reported is not None:
                    note(WOKEN, reported)
            except Exception as error:
                lose(error)

    return traced_wait


def trace_takes(recorder: Recorder, executor_class: Any, replace: Replace) -> None:
    """
    Report when an executor collects a ready entity and when its data is taken.

    The only way to the take is the function that rclpy hands to ``_make_handler`` (3.3 to 9.1,
    ``executors.py``); where that is missing the trace has no such events.
    """
    original = executor_class.__dict__.get('_make_handler')
    if original is None:
        return
    if native is None:
        traced = _plain_make_handler(recorder, original)
    else:
        journal, find, lose = recorder.journal, recorder.note_entity, recorder.lose
        traced = native.make_handler(
            original, TAKE, COLLECT, journal, recorder.entities, find, lose
        )
    replace(executor_class, '_make_handler', functools.update_wrapper(traced, original))


def _plain_make_handler(recorder: Recorder, original: Any) -> Any:
    entities, find = recorder.entities, recorder.note_entity
    note, lose = recorder.journal.note, recorder.lose

    def make_handler(*args: Any, **named: Any) -> Any:
        record, number = None, None
        try:
            executor, entity, node, take, *more = args
            record = entities.get(id(entity)) or find(entity.callback_group, entity)
            number = record.number
        except Exception as error:
            lose(error)
        if number is None:
            return original(*args, **named)

        def traced_take(taken: Any) -> Any:
            data = take(taken)
            try:
                note(TAKE, number)
            except Exception as error:
                lose(error)
            return data

        task = original(executor, entity, node, traced_take, *more, **named)
        try:
            task._ros2cc_record = record
            note(COLLECT, number)
        except Exception as error:
            lose(error)
        return task

    return make_handler


def trace_submits(recorder: Recorder, executor: Any) -> None:
    """
    Report when a task is first handed to an executor's pool of threads.

    rclpy hands over all that has not begun on every lap, which changes nothing (9.1,
    ``executors.py``). Nothing here keeps the pool alive: its threads end when it is let go.
    """
    pool = executor._executor
    submit, pool_ref = type(pool).submit, weakref.ref(pool)
    if native is None:
        traced = _plain_submit(recorder, submit, pool_ref)
    else:
        traced = native.submit_function(submit, SUBMIT, recorder.journal, pool_ref, recorder.lose)
    pool.submit = functools.update_wrapper(traced, submit)


def _plain_submit(recorder: Recorder, submit: Any, pool_ref: Any) -> Any:
    lose = recorder.lose

    def traced_submit(function: Any, /, *args: Any, **kwargs: Any) -> Any:
        try:
            record = getattr(function, '_ros2cc_record', None)
            if record is not None and not function._ros2cc_submitted:
                function._ros2cc_submitted = True
                report(recorder, SUBMIT, record)
        except Exception as error:
            lose(error)
        return submit(pool_ref(), function, *args, **kwargs)

    return traced_submit


def trace_runs(recorder: Recorder, task_class: Any, replace: Replace) -> None:
    """
    Report runs of work outside every group, and when a coroutine of any kind pauses and goes on.

    rclpy runs a paused coroutine on every lap to see whether it can go on (7.1, ``task.py``);
    runs that change nothing are left out.
    """
    original = task_class.__dict__['__call__']
    steps = _Steps(recorder)
    run: Any = _whole_run(recorder, steps, original)
    if native is not None:
        journal, lose = recorder.journal, recorder.lose
        run = native.run_method(original, journal, TaskRecord, run, steps.end, lose)
    for name, value in _KEPT_WITH_TASKS.items():
        replace(task_class, name, value)
    replace(task_class, '__call__', functools.update_wrapper(run, original))


def _whole_run(recorder: Recorder, steps: _Steps, original: Any) -> Any:
    lose = recorder.lose

    def run(task: Any) -> Any:
        record = task._ros2cc_record
        if record is None:
            return run_unmarked(task)
        begun = None
        try:
            if task._ros2cc_suspended or type(record) is TaskRecord:
                begun = steps.begin(task, record)
        except Exception as error:
            lose(error)
        try:
            return original(task)
        finally:
            try:
                # A task that is done has let go of its handler, without a lock to ask for.
                if begun is not None or task._handler is not None:
                    steps.end(task, record, begun)
            except Exception as error:
                lose(error)

    def run_unmarked(task: Any) -> Any:
        began = _clock()
        try:
            return original(task)
        finally:
            try:
                task._ros2cc_early = began, _clock(), get_ident()
                if task._ros2cc_record is not None:
                    report_early_run(recorder, task)
            except Exception as error:
                lose(error)

    return run


def mark_task(recorder: Recorder, task: Any, record: TaskRecord) -> None:
    """Note the record of a task; it may have run already, in the thread of the executor."""
    report(recorder, TASK, record)
    task._ros2cc_record = record
    report_early_run(recorder, task)


def report_early_run(recorder: Recorder, task: Any) -> None:
    """Report a run that was over before the task was marked; the first thread there does so."""
    early = vars(task).pop('_ros2cc_early', None)
    if early is not None:
        began, paused, thread = early
        number = task._ros2cc_record.number
        recorder.journal.put(began, thread, RUN, number)
        recorder.journal.put(paused, thread, PAUSE, number)


class _Steps:
    """What to report of one run of a task: when it began, and whether that has been reported."""

    def __init__(self, recorder: Recorder) -> None:
        self._journal = recorder.journal

    def begin(self, task: Any, record: Any) -> tuple[int, bool | None] | None:
        """
        Give when it began and whether that has been reported; ``None`` when nothing will happen.

        Where another thread asks a coroutine whether it can go on, this one may still run it.
        """
        if task.done():
            return None
        if task.executing():
            return None if type(record) is TaskRecord else (_clock(), None)
        clock, moves = _clock(), _can_go_on(task)
        if moves:
            self._report_begin(clock, task, record)
        return clock, moves

    def end(self, task: Any, record: Any, begun: tuple[int, bool | None] | None = None) -> None:
        if begun is not None:
            clock, reported = begun
            is_other = reported is None and (not task.done() or task._ros2cc_resumed)
            if is_other or (reported is False and not _can_go_on(task)):
                return
            if not reported:
                self._report_begin(clock, task, record)
        elif task.executing() or task._ros2cc_suspended or not _is_paused(task):
            return
        is_work = type(record) is TaskRecord
        if begun is not None and _was_in_vain(task):
            self._journal.note(VAIN, record.number)
            return
        if not task.done():
            task._ros2cc_awaited = _innermost_future(task._handler)
            task._ros2cc_suspended, task._ros2cc_resumed = True, False
        elif not is_work:
            return
        what = PAUSE if is_work else SUSPEND
        self._journal.note(what, record.number)

    def _report_begin(self, clock: int, task: Any, record: Any) -> None:
        task._ros2cc_resumed = True
        what = RUN if type(record) is TaskRecord else RESUME
        self._journal.put(clock, get_ident(), what, record.number)


def _can_go_on(task: Any) -> bool:
    awaited = task._ros2cc_awaited
    return awaited is None or task.done() or awaited.done()


def _was_in_vain(task: Any) -> bool:
    """
    Return whether another thread ran it: both had found it not begun, or able to go on.

    Two laps hand over one task, and two workers take it at a time (7.1, ``task.py``: the second
    one finds its lock taken, a moment before it is said to be executing).
    """
    if not task.done():
        lock = getattr(task, '_task_lock', None)
        return bool(task.executing() or (lock is not None and lock.locked()))
    was_over, task._ros2cc_over = task._ros2cc_over, True
    return bool(was_over)


def _is_paused(task: Any) -> bool:
    """Distinguish a pause from a call in vain: another thread may hold a task not run yet."""
    handler = task._handler
    if not inspect.iscoroutine(handler):
        return False
    return inspect.getcoroutinestate(handler) == inspect.CORO_SUSPENDED


def _innermost_future(coroutine: Any) -> Any:
    """Give the future of rclpy that a paused coroutine waits for, ``None`` if it is another's."""
    inner = coroutine
    while inner is not None:
        last = inner
        inner = getattr(inner, 'cr_await', None) or getattr(inner, 'gi_yieldfrom', None)
    frame = getattr(last, 'gi_frame', None)
    future = frame.f_locals.get('self') if frame is not None else None
    return future if hasattr(future, 'add_done_callback') else None
