"""Folding of constants, within limits: no value that the source does not already show in size."""

from __future__ import annotations

import ast
import builtins
import operator
import re
from collections.abc import Callable
from typing import Any

from ros2cc_extract.extract.static.python.values.containers import Mapping, Sequence
from ros2cc_extract.extract.static.python.values.object_identity import Identity
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    Bound,
    Choice,
    Class,
    Const,
    Function,
    Instance,
    Module,
    Mystery,
    Partial,
    Value,
)

_TEXT_LIMIT = 10_000
_NUMBER_LIMIT = 1 << 128

_WIDE = re.compile(r'\d{4}')

_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.BitOr: operator.or_,
    ast.BitAnd: operator.and_,
    ast.BitXor: operator.xor,
}

COMPARISONS: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}

_BUILTIN_NAMES = frozenset(dir(builtins))
_TROUBLE = (ArithmeticError, TypeError, ValueError, LookupError, MemoryError)


def is_builtin(name: str) -> bool:
    """Whether ``name`` is one of Python's own."""
    return name in _BUILTIN_NAMES


def binary(op: ast.operator, left: Value, right: Value) -> Const | None:
    """The constant that ``left op right`` gives, if it is one of modest size."""
    if not isinstance(left, Const):
        return None
    if isinstance(op, ast.Mod) and isinstance(left.value, str):
        return _percent(left.value, right)
    if not isinstance(right, Const):
        return None
    if isinstance(op, ast.Pow):
        return _power(left.value, right.value)
    act = _BINARY.get(type(op))
    if act is None or _is_large_product(op, left.value, right.value):
        return None
    return _guarded(lambda: act(left.value, right.value))


def _is_large_product(op: ast.operator, left: Any, right: Any) -> bool:
    if not isinstance(op, ast.Mult):
        return False
    text = next((side for side in (left, right) if isinstance(side, (str, bytes))), None)
    number = next((side for side in (left, right) if isinstance(side, int)), 0)
    return text is not None and len(text) * max(number, 1) > _TEXT_LIMIT


def _power(left: Any, right: Any) -> Const | None:
    if not isinstance(left, (int, float)) or not isinstance(right, (int, float)):
        return None
    if abs(right) > 64 or abs(left) > 1_000_000:
        return None
    return _guarded(lambda: left**right)


def _percent(template: str, right: Value) -> Const | None:
    if isinstance(right, Mapping):
        return _percent_of_names(template, right)
    items = right.items if isinstance(right, Sequence) and right.kind == 'tuple' else (right,)
    if not all(isinstance(item, Const) for item in items) or '*' in template:
        return None
    if is_wide(template):
        return None
    values = tuple(item.value for item in items if isinstance(item, Const))
    return _guarded(lambda: template % values) if len(template) < _TEXT_LIMIT else None


def _percent_of_names(template: str, right: Mapping) -> Const | None:
    entries = right.entries.items()
    values = {
        k.value: v.value for k, v in entries if isinstance(k, Const) and isinstance(v, Const)
    }
    if len(values) < len(right.entries) or right.rest is not None or is_wide(template):
        return None
    return _guarded(lambda: template % values) if '*' not in template else None


def is_wide(template: str) -> bool:
    """Whether a format asks for a field so wide that filling it would cost memory."""
    return len(template) > _TEXT_LIMIT or _WIDE.search(template) is not None


def _guarded(act: Callable[[], Any]) -> Const | None:
    try:
        value = act()
    except _TROUBLE:
        return None
    if isinstance(value, (str, bytes)) and len(value) > _TEXT_LIMIT:
        return None
    if isinstance(value, int) and abs(value) > _NUMBER_LIMIT:
        return None
    if isinstance(value, complex):
        return None
    return Const(value)


def unary(op: ast.unaryop, value: Value) -> Const | None:
    """The constant that ``op value`` gives."""
    if not isinstance(value, Const) or not isinstance(value.value, (int, float)):
        return None
    if isinstance(op, ast.USub):
        return Const(-value.value)
    if isinstance(op, ast.UAdd):
        return Const(+value.value)
    return Const(~value.value) if isinstance(value.value, int) else None


def joined(parts: list[str]) -> Const | None:
    """The text that ``parts`` make, if it is not long."""
    return Const(''.join(parts)) if sum(map(len, parts)) <= _TEXT_LIMIT else None


def formatted(value: Const, spec: str) -> Const | None:
    """``format(value, spec)`` for short specifications."""
    if is_wide(spec):
        return None
    return _guarded(lambda: format(value.value, spec))


def subscript(owner: Const, key: Const) -> Const | None:
    """A character of a constant string."""
    return _guarded(lambda: owner.value[key.value]) if isinstance(owner.value, str) else None


def compare(op: ast.cmpop, left: Value, right: Value) -> bool | None:
    """Whether a comparison holds; ``None`` when that depends."""
    if isinstance(op, (ast.Is, ast.IsNot)):
        same = _identical(left, right)
        return same if same is None or isinstance(op, ast.Is) else not same
    if isinstance(op, (ast.In, ast.NotIn)):
        inside = _contains(right, left)
        return inside if inside is None or isinstance(op, ast.In) else not inside
    if isinstance(left, Const) and isinstance(right, Const):
        try:
            return bool(COMPARISONS[type(op)](left.value, right.value))
        except _TROUBLE:
            return None
    if isinstance(left, Identity) and isinstance(right, Identity):
        one, other = left.thing.serial, right.thing.serial
        return bool(COMPARISONS[type(op)](one, other)) if one != other else None
    if isinstance(op, (ast.Eq, ast.NotEq)) and _are_constant_and_callable(left, right):
        return isinstance(op, ast.NotEq)
    if isinstance(op, (ast.Eq, ast.NotEq)) and _is_sure(left) and _is_sure(right):
        same = _identical(left, right)
        if same is not None and not isinstance(left, (Sequence, Mapping)):
            return same if isinstance(op, ast.Eq) else not same
    return None


def _are_constant_and_callable(left: Value, right: Value) -> bool:
    """A method is no constant: ``self.on_news != None``."""
    return any(
        isinstance(one, Const) and isinstance(other, (Bound, Partial))
        for one, other in ((left, right), (right, left))
    )


def _is_sure(value: Value) -> bool:
    return isinstance(value, (Const, Instance, Class, Function, Module))


def _identical(left: Value, right: Value) -> bool | None:
    for one, other in ((left, right), (right, left)):
        if isinstance(one, Choice):
            verdicts = {_identical(o, other) for o in one.options if o is not ABSENT}
            return verdicts.pop() if len(verdicts) == 1 else None
    if isinstance(left, Mystery) or isinstance(right, Mystery):
        return None
    if isinstance(left, Const) and isinstance(right, Const):
        return left == right
    if isinstance(left, Const) or isinstance(right, Const):
        other = right if isinstance(left, Const) else left
        return False if type(other).__name__ != 'Library' else None
    return left is right or (left == right)


def _contains(owner: Value, item: Value) -> bool | None:
    if isinstance(owner, Const) and isinstance(item, Const):
        if isinstance(owner.value, str) and isinstance(item.value, str):
            return item.value in owner.value
        return None
    if isinstance(owner, Mapping) and _is_sure(item):
        entry = owner.entries.get(item)
        if entry is not None and not (isinstance(entry, Choice) and ABSENT in entry.options):
            return True
        return None if owner.rest or entry is not None else False
    if isinstance(owner, Sequence) and _is_sure(item):
        if item in owner.items:
            return True
        certain = all(_is_sure(known) for known in owner.items)
        return False if certain and owner.rest is None else None
    return None
