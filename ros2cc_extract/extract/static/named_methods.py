"""Methods that are found by a name of which only the beginning or the end is known."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.machine import Machine
from ros2cc_extract.extract.static.values import (
    Call,
    Class,
    Function,
    Instance,
    Mystery,
    Value,
    choice,
    options_of,
)

_MANY = 40


def methods_named_like(machine: Machine, call: Call) -> Value | None:
    """What ``getattr(owner, f'do_{word}')`` may give: each method so named, or the default."""
    name = call.args[1]
    ends = _ends_of(name.node) if isinstance(name, Mystery) else None
    if ends is None:
        return None
    found: list[Value] = []
    for owner in options_of(call.args[0]):
        if not isinstance(owner, Instance):
            return None
        names = dict.fromkeys(_methods(owner, *ends))
        found += (machine.attribute(owner, each, call.place) for each in names)
    default = call.argument(2)
    if not 0 < len(found) <= _MANY:
        return None
    return choice([*found, default] if default is not None else found)


def _methods(owner: Instance, first: str, last: str) -> Iterator[str]:
    for cls in owner.mro:
        for name, value in cls.slots.items() if isinstance(cls, Class) else ():
            is_named = name.startswith(first) and name.endswith(last)
            if isinstance(value, Function) and is_named and len(name) > len(first + last):
                yield name


def _ends_of(text: ast.expr | None) -> tuple[str, str] | None:
    """How an f-string begins and ends, if anything of it is known."""
    if not isinstance(text, ast.JoinedStr):
        return None
    first, last = (
        str(part.value) if isinstance(part, ast.Constant) else ''
        for part in (text.values[0], text.values[-1])
    )
    return (first, last) if first or last else None
