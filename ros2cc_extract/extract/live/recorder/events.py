"""
One step of an executor as it is kept in memory and in the raw trace: 24 bytes.

Bytes and not a tuple: on the way of a callback they cost a third of the memory, and the garbage
collector never looks at them. Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator

# What happened; the first three, up to ``END``, are always recorded, the others for a trace.
EVENT_NAMES = (
    'begin',
    'refused',
    'end',
    'wait>',
    'wait<',
    'collect',
    'submit',
    'take',
    'suspend',
    'resume',
    'task',
    'run',
    'pause',
    'vain',
)
(
    BEGIN,
    REFUSED,
    END,
    WAIT,
    WOKEN,
    COLLECT,
    SUBMIT,
    TAKE,
    SUSPEND,
    RESUME,
    TASK,
    RUN,
    PAUSE,
    VAIN,
) = range(len(EVENT_NAMES))
# Only in the raw trace: a name follows, of as many bytes as the last number says; and events came
# faster than they could be kept.
THREAD_NAME, LOST = 254, 255

# Beside the recording of a process, after the name of its file.
RAW_SUFFIX = '.events'

# Monotonic clock in nanoseconds, thread, what, and whose: the number of an entity, a task or an
# executor. Only entities begin, end and are refused.
# The formats named after C's long are packed in half the time of the others.
_EVENT = struct.Struct('@lLII' if struct.calcsize('@l') == 8 else '@qQII')
SIZE = _EVENT.size
Fields = tuple[int, int, int, int]
pack = _EVENT.pack


def unpack(events: bytes) -> Iterator[Fields]:
    """Read events put one after the other."""
    return _EVENT.iter_unpack(events)


def thread_name(thread: int, name: str) -> bytes:
    """Return a record of the raw trace: what a thread is called."""
    text = name.encode('utf-8', 'replace')
    return pack(0, thread, THREAD_NAME, len(text)) + text


def loss() -> bytes:
    """Return a record of the raw trace: the oldest events are gone."""
    return pack(0, 0, LOST, 0)


def rows(raw: bytes) -> Iterator[tuple[Fields, str]]:
    """Read a raw trace, each row with the name that follows it; a row cut off is left out."""
    at = 0
    while at + SIZE <= len(raw):
        fields: Fields = _EVENT.unpack_from(raw, at)
        at += SIZE
        name = b''
        if fields[2] == THREAD_NAME:
            name = raw[at : at + fields[3]]
            at += fields[3]
        yield fields, name.decode('utf-8', 'replace')
