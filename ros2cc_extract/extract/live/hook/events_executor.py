"""
Measures callbacks of the executor written in C++, which never asks a callback group.

rclpy 7.1.4 and later, ``rclpy/experimental/events_executor.py``: for each event it reads the
attribute ``callback`` of the entity and calls what it gets. So that attribute, read from there
and from nowhere else, gives a function that notes begin and end; no other code ever sees it.
Coroutine functions are left as they are: the executor asks what they are.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import functools
import inspect
import sys
from collections.abc import Callable
from typing import Any

from ..recorder.entries import EntityRecord
from ..recorder.events import BEGIN, END
from ..recorder.record import Recorder

Replace = Callable[[type, str, Any], None]
SPINNING = ('spin', 'spin_once', 'spin_until_future_complete', 'spin_once_until_future_complete')
_KEPT = '_ros2cc_measured'


def mark_spinning(executor_class: Any, replace: Replace) -> None:
    """Put a frame of ours around the C++ code, which distinguishes its reading from others'."""
    for name in SPINNING:
        original = executor_class.__dict__.get(name)
        if original is not None:
            replace(executor_class, name, functools.wraps(original)(_spinning(original)))


def _spinning(original: Any) -> Any:
    def spin(executor: Any, *args: Any, **kwargs: Any) -> Any:
        return original(executor, *args, **kwargs)

    return spin


_SPIN_CODE = _spinning(None).__code__


def measure_callbacks(recorder: Recorder, entity_class: Any, replace: Replace) -> None:
    """Let the C++ code get a measured callback from entities of this class."""
    get, put = _access(inspect.getattr_static(entity_class, 'callback', None))

    def callback(entity: Any) -> Any:
        function = get(entity)
        try:
            if sys._getframe(1).f_code is _SPIN_CODE:
                return _measured(recorder, entity, function)
        except Exception as error:
            recorder.lose(error)
        return function

    replace(entity_class, 'callback', property(callback, put))


def _access(found: Any) -> tuple[Callable[[Any], Any], Callable[[Any, Any], None]]:
    """
    Give what reads and writes an attribute whose place a property takes.

    It may be a property of a base (10.0, ``subscription.py``) that does more than to keep a value.
    """
    if inspect.isdatadescriptor(found):
        descriptor: Any = found
        return lambda entity: descriptor.__get__(entity, type(entity)), descriptor.__set__
    return _stored, _store


def _stored(entity: Any) -> Any:
    try:
        return vars(entity)['callback']
    except KeyError:
        raise AttributeError('callback') from None


def _store(entity: Any, function: Any) -> None:
    vars(entity)['callback'] = function


def _measured(recorder: Recorder, entity: Any, function: Any) -> Any:
    """Give the same object for the same callback: the C++ code relies on the entity owning it."""
    kept = vars(entity).setdefault(_KEPT, {})
    for known, measured in kept.values():
        if known is function:
            return measured
    measured = function
    if not inspect.iscoroutinefunction(function):
        record = recorder.entities.get(id(entity))
        record = record or recorder.note_entity(entity.callback_group, entity)
        measured = _measure(function, record, recorder)
    kept[len(kept)] = function, measured
    return measured


def _measure(function: Any, record: EntityRecord, recorder: Recorder) -> Any:
    note, lose, number = recorder.journal.note, recorder.lose, record.number

    @functools.wraps(function)
    def measured(*args: Any, **kwargs: Any) -> Any:
        try:
            note(BEGIN, number)
        except Exception as error:
            lose(error)
        try:
            return function(*args, **kwargs)
        finally:
            try:
                note(END, number)
            except Exception as error:
                lose(error)

    return measured
