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


def reporting(recorder: Recorder, group: type, name: str, what: int, otherwise: int) -> Any:
    """
    Give what reports each call of a method of a group class, to stand in its place.

    A subclass that calls its base is reported once, by its own wrapper.

    :param what: the event when the method gives true, else it is ``otherwise``.
    """
    original = group.__dict__[name]
    if native is None:
        return _plain(recorder, group, name, what, otherwise)
    journal, find, lose = recorder.journal, recorder.note_entity, recorder.lose
    method = native.group_method(
        original, group, what, otherwise, journal, recorder.entities, find, lose
    )
    return functools.update_wrapper(method, original)


def _plain(recorder: Recorder, group: type, name: str, what: int, otherwise: int) -> Any:
    original = group.__dict__[name]
    entities, find = recorder.entities, recorder.note_entity
    note, lose = recorder.journal.note, recorder.lose

    @functools.wraps(original)
    def method(self: Any, entity: Any) -> Any:
        result = original(self, entity)
        try:
            if type(self) is group or getattr(type(self), name) is method:
                try:
                    record = entities[id(entity)]
                except KeyError:
                    record = find(self, entity)
                note(what if result else otherwise, record.number)
        except Exception as error:
            lose(error)
        return result

    return method
