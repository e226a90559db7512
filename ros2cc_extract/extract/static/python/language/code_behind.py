"""Code behind plain statements: what assigns properties, and methods that stand for operators."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.builtins.properties import ACCESSORS
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place

_OPERATORS: dict[type[ast.operator], str] = {
    ast.Add: 'add',
    ast.Sub: 'sub',
    ast.Mult: 'mul',
    ast.MatMult: 'matmul',
    ast.Div: 'truediv',
    ast.FloorDiv: 'floordiv',
    ast.Mod: 'mod',
    ast.Pow: 'pow',
    ast.LShift: 'lshift',
    ast.RShift: 'rshift',
    ast.BitAnd: 'and',
    ast.BitOr: 'or',
    ast.BitXor: 'xor',
}


def setters_of(owner: Value, name: str, kind: str = 'setter') -> list[Bound]:
    """What ``owner.name = …``, or ``del owner.name``, calls instead of storing anything."""
    if not isinstance(owner, Instance):
        return []
    for cls in owner.mro:
        if isinstance(cls, Class) and name in cls.slots:
            known = cls.slots[name]
            setter = known.slots.get(ACCESSORS[kind]) if isinstance(known, Function) else None
            return [Bound(owner, setter)] if isinstance(setter, Function) else []
    return []


def is_assigned_by_call(machine: Machine, target: ast.Attribute, frame: Frame) -> bool:
    """Whether ``target = …`` may call a setter."""
    return bool(_behind(machine, target, frame, 'setter'))


def _behind(machine: Machine, target: ast.Attribute, frame: Frame, kind: str) -> list[Bound]:
    noted, machine.world.effects = machine.world.effects, None
    owner = machine.evaluate(target.value, frame)
    machine.world.effects = noted
    name = frame.attribute_name(target.attr)
    return [each for option in options_of(owner) for each in setters_of(option, name, kind)]


def delete(machine: Machine, target: ast.Attribute, frame: Frame) -> None:
    """``del owner.name`` runs the code behind it."""
    for deleter in _behind(machine, target, frame, 'deleter'):
        machine.call(deleter, Call(frame.place(target)))


def assign(machine: Machine, setter: Bound, value: Value, place: Place) -> None:
    """``owner.name = value`` runs the code behind it, which knows what ``value`` rests on."""
    reading = machine.world.reading
    waited, reading.waited = reading.waited, None
    call = Call(waited or place, [value])
    if reading.flowing:
        call.sources[0] = reading.flowing
    reading.calls += 1
    machine.call(setter, call)
    reading.waited = waited


def operated(
    machine: Machine, op: ast.operator, left: Value, right: Value, place: Place, *, augmented: bool
) -> Value | None:
    """``left op right``, where a method of one of them says what that is."""
    name = _OPERATORS[type(op)]
    ways = [(left, f'__{name}__', right), (right, f'__r{name}__', left)]
    if augmented:
        ways.insert(0, (left, f'__i{name}__', right))
    for owner, called, other in ways:
        method = machine.special_method(owner, called, place)
        if method is not None:
            return machine.call(method, Call(place, [other]))
    return None
