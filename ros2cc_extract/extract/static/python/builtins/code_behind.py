"""Code behind plain statements: what assigns properties, and methods that stand for operators."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Choice,
    Class,
    Const,
    Function,
    Instance,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

ACCESSORS = {'setter': '<setter>', 'deleter': '<deleter>'}

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


@dataclass(frozen=True)
class Setter:
    """
    What an assignment calls.

    :param given: what it gets before the value.
    """

    method: Bound
    given: tuple[Value, ...] = ()


def with_accessor(
    machine: Machine, known: Value, kind: str, accessor: Value | None
) -> Function | None:
    """``@known.setter``: a property like ``known`` that is assigned by calling ``accessor``."""
    if not isinstance(known, Function) or known.binding != 'property':
        return None
    made = Function(known.node, known.module, known.qualname, known.scope)
    made.owner, made.binding = known.owner, known.binding
    made.defaults = known.defaults
    made.keyword_defaults.update(known.keyword_defaults)
    for name in ACCESSORS.values():
        if name in known.slots:
            machine.store.write(made, name, known.slots[name])
    if isinstance(accessor, Function):
        machine.store.write(made, ACCESSORS[kind], accessor)
    return made


def setters_of(machine: Machine, owner: Value, name: str) -> list[Setter]:
    """What ``owner.name = …`` calls instead of storing anything."""
    own = machine.special_method(owner, '__setattr__', Place(''))
    if own is not None:
        return [Setter(own, (Const(name),))]
    return setters_behind(machine, owner, name)


def setters_behind(
    machine: Machine, owner: Value, name: str, kind: str = 'setter'
) -> list[Setter]:
    """The same of ``object.__setattr__``: properties and descriptors of the class."""
    if not isinstance(owner, Instance):
        return []
    for cls in owner.mro:
        if isinstance(cls, Class) and name in cls.slots:
            known = cls.slots[name]
            setter = known.slots.get(ACCESSORS[kind]) if isinstance(known, Function) else None
            if isinstance(setter, Function):
                return [Setter(Bound(owner, setter))]
            called = '__set__' if kind == 'setter' else '__delete__'
            method = machine.special_method(known, called, Place(''))
            return [Setter(method, (owner,))] if method is not None else []
    return []


def is_assigned_by_call(machine: Machine, target: ast.Attribute, frame: Frame) -> bool:
    """Whether ``target = …`` may call a setter."""
    name = frame.attribute_name(target.attr)
    return any(setters_of(machine, each, name) for each in _owners(machine, target, frame))


def _owners(machine: Machine, target: ast.Attribute, frame: Frame) -> tuple[Value, ...]:
    noted, machine.world.effects = machine.world.effects, None
    owner = machine.evaluate(target.value, frame)
    machine.world.effects = noted
    return tuple(options_of(owner))


def delete(machine: Machine, target: ast.Attribute, frame: Frame) -> None:
    """``del owner.name`` runs the code behind it."""
    name, place = frame.attribute_name(target.attr), frame.place(target)
    for owner in _owners(machine, target, frame):
        machine.note_attribute(owner, name, AccessKind.WRITE, place)
        own = machine.special_method(owner, '__delattr__', place)
        if own is not None:
            machine.call(own, Call(place, [Const(name)]))
            continue
        for deleter in setters_behind(machine, owner, name, 'deleter'):
            machine.call(deleter.method, Call(place, [*deleter.given]))


def assign(machine: Machine, setter: Setter, value: Value, place: Place) -> None:
    """``owner.name = value`` runs the code behind it, which knows what ``value`` rests on."""
    reading = machine.world.reading
    waited, reading.waited = reading.waited, None
    # What the value rests on was read before, also where it stands further right.
    begin = waited or (reading.value_end if reading.flowing else None) or place
    call = Call(begin, [*setter.given, value])
    if reading.flowing:
        call.sources[len(setter.given)] = reading.flowing
    reading.calls += 1
    is_whole, reading.is_whole = reading.is_whole, False
    machine.call(setter.method, call)
    reading.waited, reading.is_whole = waited, is_whole


_CONVERSIONS = {
    'str': ('__str__', '__repr__'),
    'repr': ('__repr__',),
    'format': ('__format__', '__str__', '__repr__'),
    'bool': ('__bool__', '__len__'),
    'int': ('__int__', '__index__'),
    'float': ('__float__', '__index__'),
    'abs': ('__abs__',),
    'round': ('__round__',),
    'hash': ('__hash__',),
    'bytes': ('__bytes__',),
    'index': ('__index__',),
    'reversed': ('__reversed__',),
    'copy': ('__copy__',),
    'deepcopy': ('__deepcopy__',),
    'next': ('__next__',),
}


def asked_as(machine: Machine, value: Value, kind: str, place: Place) -> None:
    """An object is asked for its truth, its text or its number: a method of it says that."""
    for option in options_of(value) if isinstance(value, Choice) else (value,):
        if not isinstance(option, Instance):
            continue
        methods = (machine.special_method(option, name, place) for name in _CONVERSIONS[kind])
        method = next((each for each in methods if each is not None), None)
        if method is not None:
            given: list[Value] = [Const('')] if method.function.name == '__format__' else []
            machine.call(method, Call(place, given))


def asked_for_texts(machine: Machine, value: Value, place: Place) -> None:
    """``'…' % value``: the items of a tuple are asked for their texts, or the one value."""
    for each in value.items if isinstance(value, Sequence) else (value,):
        asked_as(machine, each, 'str', place)


_UNARY: dict[type[ast.unaryop], str] = {
    ast.USub: '__neg__',
    ast.UAdd: '__pos__',
    ast.Invert: '__invert__',
}


def negated(machine: Machine, op: ast.unaryop, value: Value, place: Place) -> Value | None:
    """``-value`` or ``~value``, where a method of it says what that is."""
    name = _UNARY.get(type(op))
    method = machine.special_method(value, name, place) if name is not None else None
    return machine.call(method, Call(place)) if method is not None else None


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
