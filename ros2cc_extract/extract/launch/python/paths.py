"""
Paths of Python launch files: ``pathlib.Path`` as the text that it stands for.

In Python a text divided by a text is an error, so that what is divided is a path.
"""

from __future__ import annotations

import os
import posixpath
from collections.abc import Callable

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Const,
    Handler,
    Mystery,
    Native,
    Value,
)
from ros2cc_extract.source_locations import Unknown

WHY = 'a path that could not be followed'
_PARTS: dict[str, Callable[[str], str]] = {
    'parent': posixpath.dirname,
    'name': posixpath.basename,
    'stem': lambda path: posixpath.splitext(posixpath.basename(path))[0],
    'suffix': lambda path: posixpath.splitext(path)[1],
}
_SAME = ('resolve', 'absolute', 'as_posix', '__str__', '__fspath__')


def join(machine: Machine, receiver: Value, call: Call) -> Value:
    """``os.path.join``, ``Path(…)``, ``path.joinpath(…)``."""
    given = [receiver, *call.args] if isinstance(receiver, Const) and receiver.value else call.args
    return joined(given) or unknown_of(given, call)


def joined(values: list[Value]) -> Value | None:
    """The path that texts make together; ``None`` where one is no text."""
    texts = [each.value for each in values if isinstance(each, Const)]
    if len(texts) == len(values) and all(isinstance(text, str) for text in texts) and texts:
        return Const(os.path.join(*texts))  # noqa: PTH118
    return None


def unknown_of(values: list[Value], call: Call) -> Value:
    """Why a path is not known."""
    why = next((each.unknown for each in values if isinstance(each, Mystery)), None)
    return Mystery(why or Unknown(WHY, call.place), 'a path')


def changed(act: Callable[[str], str]) -> Handler:
    """A function of one path, such as ``os.path.dirname``."""

    def handler(machine: Machine, receiver: Value, call: Call) -> Value:
        given = call.args[:1]
        if given and isinstance(given[0], Const) and isinstance(given[0].value, str):
            return Const(act(given[0].value))
        return unknown_of(given, call)

    return handler


def member(value: Value, name: str) -> Value | None:
    """``path.parent`` and the like; ``None`` for a name that no path has."""
    if not isinstance(value, Const) or not isinstance(value.value, str):
        return None
    if name in _PARTS:
        return Const(_PARTS[name](value.value))
    if name == 'joinpath':
        return Native(name, join, value)
    if name in _SAME:
        return Native(name, lambda machine, receiver, call: receiver, value)
    return None
