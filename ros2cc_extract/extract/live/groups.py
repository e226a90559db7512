"""
Reports when a callback's group lets it begin, refuses it, and is told of its end.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. What is here, or its like in C (``journal.py``), is all that stands on the way of a
callback when no trace is asked for.
"""

from __future__ import annotations

import functools
from typing import Any

from .journal import native
from .record import Recorder

# Of types whose objects become methods of the instance that they are found on, as functions do:
# Py_TPFLAGS_METHOD_DESCRIPTOR.
_BINDS = 1 << 17


def reporting(recorder: Recorder, group: type, name: str, what: int, otherwise: int) -> Any:
    """
    Give what reports each call of a method of a group class, to stand in its place.

    A subclass that calls its base is reported once, by its own wrapper.

    :param what: the event when the method gives true, else it is ``otherwise``.
    :raises TypeError: when it is something else than a function, which would be called otherwise.
    """
    original = group.__dict__[name]
    if not type(original).__flags__ & _BINDS:
        raise TypeError(f'{group.__qualname__}.{name} is no function')
    if native is None:
        return _plain(recorder, group, name, what, otherwise)
    journal, find, lose = recorder.journal, recorder.note_entity, recorder.lose
    method = native.group_method(
        original, (group, name), what, otherwise, journal, recorder.entities, find, lose
    )
    return functools.update_wrapper(method, original)


def _plain(recorder: Recorder, group: type, name: str, what: int, otherwise: int) -> Any:
    original = group.__dict__[name]
    entities, find = recorder.entities, recorder.note_entity
    note, lose = recorder.journal.note, recorder.lose

    @functools.wraps(original)
    def method(*args: Any, **named: Any) -> Any:
        result = original(*args, **named)
        try:
            asked, entity = args[0], args[1] if len(args) > 1 else named['entity']
            if type(asked) is group or getattr(type(asked), name) is method:
                try:
                    record = entities[id(entity)]
                except KeyError:
                    record = find(asked, entity)
                note(what if result else otherwise, record.number)
        except Exception as error:
            lose(error)
        return result

    return method
