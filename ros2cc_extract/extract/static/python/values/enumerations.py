"""
Enumerations of the program: each member is a constant, equal to itself alone.

Those that are numbers or texts as well (``IntEnum``, ``class State(str, Enum)``) keep these.
Source: CPython 3.12, ``enum.py`` (``auto`` counts from 1; members of ``Enum`` are true).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import field

from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Class,
    Const,
    Function,
    Library,
    Mystery,
    Value,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown

_PLAIN = frozenset({'enum.Enum'})
_NUMBERS = frozenset({'enum.IntEnum', 'builtins.int'})
_TEXTS = frozenset({'enum.StrEnum'})


@dataclass(frozen=True)
class Member:
    """A member of an enumeration that is nothing else."""

    owner: str
    name: str
    value: Value = field(compare=False)
    cls: Class = field(compare=False)

    def __repr__(self) -> str:
        return f'{self.owner.rpartition(".")[2]}.{self.name}'

    def method(self, name: str) -> Function | None:
        """The function that its class has under ``name``."""
        classes = (cls for cls in self.cls.mro if isinstance(cls, Class) and name in cls.slots)
        found = next((cls.slots[name] for cls in classes), None)
        return found if isinstance(found, Function) else None

    def attribute(self, name: str, place: Place) -> Value:
        """What the member has under ``name``, if that is no function."""
        if name == 'name':
            return Const(self.name)
        reason = f'{name!r} of a member of an enumeration'
        return self.value if name == 'value' else Mystery(Unknown(reason, place))


def settle(cls: Class, slots: dict[str, Value]) -> None:
    """After the body of a class was run: what its names stand for, if it is an enumeration."""
    bases = _libraries(cls)
    is_plain = bool(bases & _PLAIN) and bases <= _PLAIN | {'builtins.object'}
    if not is_plain and not bases & (_NUMBERS | _TEXTS):
        return
    if not any(base.startswith('enum.') for base in bases):
        return
    number, owner = 0, _name_of(cls)
    known: dict[Value, Value] = {}
    for name, text in _assigned(cls.node):
        value = slots.get(name, Const(None))
        if _is_auto(text):
            value = Const(name.lower() if bases & _TEXTS else number + 1)
        if isinstance(value, Const) and isinstance(value.value, int):
            number = value.value
        member = Const(Member(owner, name, value, cls)) if is_plain else value
        slots[name] = known.setdefault(value, member) if isinstance(value, Const) else member


def made(cls: Class, call: Call) -> Value | None:
    """``State(1)``: the member that has this value, if that is known; ``None`` elsewhere."""
    members = members_of(cls)
    if not members:
        return None
    given = call.args[0] if call.args else None
    same = (each for each in members if given in (each, each.value.value))
    reason = f'a member of {cls.name}'
    return next(same, None) or Mystery(Unknown(reason, call.place), cls.name)


def members_of(cls: Class) -> list[Const]:
    """The members in their order, each once; none of a class that is no plain enumeration."""
    owner = _name_of(cls)
    found = (value for value in cls.slots.values() if isinstance(value, Const))
    return list(
        dict.fromkeys(
            each for each in found if isinstance(each.value, Member) and each.value.owner == owner
        )
    )


def _name_of(cls: Class) -> str:
    return f'{cls.module.name}.{cls.qualname}'


def _libraries(cls: Class) -> frozenset[str]:
    return frozenset(base.name for base in cls.mro if isinstance(base, Library))


def _assigned(node: ast.ClassDef) -> Iterator[tuple[str, ast.expr]]:
    """The names that a class body gives values to, but private ones."""
    for statement in node.body:
        if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
            target = statement.targets[0]
            if isinstance(target, ast.Name) and not target.id.startswith('_'):
                yield target.id, statement.value


def _is_auto(text: ast.expr) -> bool:
    function = text.func if isinstance(text, ast.Call) else None
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, 'id', '')
    return name == 'auto'
