"""Methods that are found by the beginning or the end of a name."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
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
    """What ``getattr(owner, 'do_' + word)`` may give: each method so named, or the default."""
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
    """How a text that the source puts together begins and ends, if anything of it is known."""
    match text:
        case ast.JoinedStr(values=[first, *_] as parts):
            ends = _constant(first), _constant(parts[-1])
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            ends = _beginning(left), _constant(right)
        case ast.BinOp(left=ast.Constant(value=str(form)), op=ast.Mod()):
            ends = form.partition('%s')[0], form.rpartition('%s')[2]
        case _:
            return None
    return ends if any(ends) else None


def _beginning(sum_: ast.expr) -> str:
    while isinstance(sum_, ast.BinOp) and isinstance(sum_.op, ast.Add):
        sum_ = sum_.left
    return _constant(sum_)


def _constant(part: ast.expr) -> str:
    return str(part.value) if isinstance(part, ast.Constant) else ''
