"""
The fields of data classes: which there are, and what they hold by default.

Source: CPython 3.12, ``dataclasses.py`` (fields of bases come first, ``_init_param`` and
``_field_init`` for the defaults; a ``default_factory`` is called for each object).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Class,
    Instance,
    Library,
    Value,
)
from ros2cc_extract.source_locations import Place


class FieldDefault(Value):
    """
    What ``field(…)`` says a field holds by default.

    :param factory: makes it anew for each object; else ``default`` is it.
    """

    __slots__ = ('default', 'factory', 'place')

    def __init__(self, place: Place, default: Value | None, factory: Value | None) -> None:
        self.place = place
        self.default = default
        self.factory = factory


def field(machine: Machine, receiver: Value, call: Call) -> Value:
    """``dataclasses.field(…)``, ``attrs.field(…)`` or ``attr.ib(…)``."""
    default, factory = call.argument(None, 'default'), call.argument(None, 'default_factory')
    factory = factory or call.argument(None, 'factory')
    if default is None and factory is None:
        return machine.mystery('a field without a default', call.place, call.text)
    return FieldDefault(call.place, default, factory)


def is_dataclass(cls: Class) -> bool:
    """Whether a decorator, or ``NamedTuple``, makes it from its fields."""
    bases = (base.name for base in cls.bases if isinstance(base, Library))
    return 'typing.NamedTuple' in bases or any(
        'dataclass' in ast.dump(decorator) or 'attr' in ast.dump(decorator)
        for decorator in cls.node.decorator_list
    )


def fill_fields(machine: Machine, cls: Class, instance: Instance, call: Call) -> None:
    """What the ``__init__`` does that a decorator makes."""
    position = 0
    for name, (owner, item) in _fields(cls).items():
        index, given = None, None
        if not _is_false(item, 'init'):
            is_positional = not _is_true(item, 'kw_only') and not _all_by_name(owner)
            index, position = (position, position + 1) if is_positional else (None, position)
            given = call.argument(index, name)
        value = given if given is not None else _default(machine, owner, name)
        if value is not None:
            machine.name_value(value, name)
            machine.store.write(instance, name, value)


def _default(machine: Machine, owner: Class, name: str) -> Value | None:
    """What ``field`` says; a plain default stays with the class, where it is found."""
    kept = owner.slots.get(name)
    if not isinstance(kept, FieldDefault):
        return None
    if kept.factory is not None:
        return machine.call(kept.factory, Call(kept.place))
    return kept.default


def _fields(cls: Class) -> dict[str, tuple[Class, ast.AnnAssign | ast.Assign]]:
    """By name, in the order of ``__init__``, each with the last class that defines it."""
    found: dict[str, tuple[Class, ast.AnnAssign | ast.Assign]] = {}
    for base in reversed(cls.mro):
        if isinstance(base, Class) and is_dataclass(base):
            found.update((name, (base, item)) for name, item in _own_fields(base))
    return found


def _own_fields(cls: Class) -> Iterator[tuple[str, ast.AnnAssign | ast.Assign]]:
    for item in cls.node.body:
        if not isinstance(item, (ast.AnnAssign, ast.Assign)):
            continue
        target = item.target if isinstance(item, ast.AnnAssign) else item.targets[0]
        if isinstance(target, ast.Name) and _is_field(item, cls.slots.get(target.id)):
            yield target.id, item


def _is_field(item: ast.AnnAssign | ast.Assign, held: object) -> bool:
    """Classes of ``attr.s`` name their fields without annotations."""
    if isinstance(item, ast.Assign):
        return isinstance(held, FieldDefault)
    return 'ClassVar' not in ast.dump(item.annotation) and not _is_marker(item.annotation)


def _is_marker(annotation: ast.expr) -> bool:
    """``_: KW_ONLY`` is no field."""
    name = annotation.attr if isinstance(annotation, ast.Attribute) else None
    return (name or getattr(annotation, 'id', '')) == 'KW_ONLY'


def _all_by_name(cls: Class) -> bool:
    return any(
        isinstance(each, ast.Call) and _says(each, 'kw_only', meant=True)
        for each in cls.node.decorator_list
    )


def _is_false(item: ast.AnnAssign | ast.Assign, name: str) -> bool:
    return isinstance(item.value, ast.Call) and _says(item.value, name, meant=False)


def _is_true(item: ast.AnnAssign | ast.Assign, name: str) -> bool:
    return isinstance(item.value, ast.Call) and _says(item.value, name, meant=True)


def _says(call: ast.Call, name: str, *, meant: bool) -> bool:
    return any(
        each.arg == name and isinstance(each.value, ast.Constant) and each.value.value is meant
        for each in call.keywords
    )
