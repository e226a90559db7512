"""
Report when a callback's group lets it begin, refuses it, and learns that it has ended.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. What is here, or its like in C (``journal.py``), is all that stands on the way of a
callback when no trace is asked for.

The clock is read after a group was asked whether a callback may begin, and before it learns of
an end: so runs in one exclusive group never overlap by the clock, as they do not in the group.

A callback that a Ctrl-C or the end of rclpy has taken off has not come to its end: it stood
where it was, for all that is known forever, and no end is reported.
"""

from __future__ import annotations

import functools
import sys
import time
from threading import get_ident
from typing import Any

from ..recorder.journal import native
from ..recorder.record import Recorder

# Of types whose objects become methods of the instance that they are found on, as functions do:
# Py_TPFLAGS_METHOD_DESCRIPTOR.
_BINDS = 1 << 17
_clock = time.monotonic_ns
#: By name, as rclpy is not loaded yet; ``exceptions.py`` and ``executors.py`` of 3.3 to 9.1.
_FROM_OUTSIDE = frozenset(
    {'KeyboardInterrupt', 'ExternalShutdownException', 'ROSInterruptException'}
)


def reporting(recorder: Recorder, group: type, name: str, what: int, otherwise: int) -> Any:
    """
    Give what reports each call of a method of a group class, to stand in its place.

    A subclass that calls its base is reported once, by its own wrapper.

    :param what: the event when the method gives true, else it is ``otherwise``; an end is both.
    :raises TypeError: when it is something else than a function, which would be called otherwise.
    """
    original = group.__dict__[name]
    if not type(original).__flags__ & _BINDS:
        raise TypeError(f'{group.__qualname__}.{name} is no function')
    if native is None:
        return _plain(recorder, group, name, what, otherwise)
    journal, find, lose = recorder.journal, recorder.note_entity, recorder.lose
    owner = group, name, is_taken_off
    method = native.group_method(
        original, owner, what, otherwise, journal, recorder.entities, find, lose
    )
    return functools.update_wrapper(method, original)


def is_taken_off(error: BaseException, frame: Any) -> bool:
    """Return whether ``error``, which is dealt with now, ends from outside what ``frame`` runs."""
    traceback = error.__traceback__
    if traceback is None or traceback.tb_frame is not frame:
        return False  # dealt with by its caller
    return any(cls.__name__ in _FROM_OUTSIDE for cls in type(error).__mro__)


def _plain(recorder: Recorder, group: type, name: str, what: int, otherwise: int) -> Any:
    original = group.__dict__[name]
    entities, find = recorder.entities, recorder.note_entity
    put, lose = recorder.journal.put, recorder.lose
    is_end = what == otherwise

    @functools.wraps(original)
    def method(*args: Any, **named: Any) -> Any:
        clock = _clock() if is_end else 0
        result = original(*args, **named)
        try:
            if not is_end:
                clock = _clock()
            asked, entity = args[0], args[1] if len(args) > 1 else named['entity']
            error = sys.exc_info()[1] if is_end else None
            if error is not None and is_taken_off(error, sys._getframe(1)):
                return result
            if type(asked) is group or getattr(type(asked), name) is method:
                try:
                    record = entities[id(entity)]
                except KeyError:
                    record = find(asked, entity)
                put(clock, get_ident(), what if result else otherwise, record.number)
        except Exception as error:
            lose(error)
        return result

    return method
