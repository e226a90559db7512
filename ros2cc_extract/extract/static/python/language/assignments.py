"""Storing values: names, attributes, items and patterns of them."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from ros2cc_extract.extract.static.python.branching import narrowed_types
from ros2cc_extract.extract.static.python.builtins import code_behind, computed_names
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.library_state import LibraryState, PlainState
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.objects.element_keys import note_item
from ros2cc_extract.extract.static.python.objects.escape import note_kept
from ros2cc_extract.extract.static.python.values.assumed_defaults import items_by_default
from ros2cc_extract.extract.static.python.values.containers import Fields, Mapping
from ros2cc_extract.extract.static.python.values.containers import Sequence as Items
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Choice,
    Const,
    Function,
    Instance,
    Library,
    Module,
    Mystery,
    Scope,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import When

MOST_UNSURE = 32
"""So many keys of a dictionary that could not be followed are kept apart."""


class Assignments(Machine):
    """What stands left of an equals sign."""

    def assign(self, target: ast.expr, value: Value, frame: Frame) -> None:
        """Store ``value`` in a name, attribute, item or pattern of them."""
        self.world.reading.stored, self.world.reading.replaced = value, None
        if frame.narrowed:
            narrowed_types.forget(self, target, frame)
        if isinstance(target, ast.Name):
            self.assign_name(target, value, frame)
        elif isinstance(target, ast.Attribute):
            self.note_part(target, frame)
            self._assign_attribute(target, value, frame)
        elif isinstance(target, ast.Subscript):
            self.note_part(target, frame)
            self._assign_item(target, value, frame)
        elif isinstance(target, (ast.Tuple, ast.List)):
            self._unpack(target.elts, value, frame)
        elif isinstance(target, ast.Starred):
            self.assign(target.value, value, frame)

    def assign_name(self, target: ast.Name, value: Value, frame: Frame) -> None:
        """Store ``value`` under a name in the scope that owns it."""
        name = target.id
        _hint(value, name)
        scope = frame.scope
        if name in scope.global_names:
            self.store.write(scope.module, name, value)
            self.note_global(scope.module, name, AccessKind.WRITE, frame.place(target))
        elif name in scope.nonlocal_names:
            owner = _owner_of(name, scope)
            self.store.write(owner, name, value)
            if isinstance(owner, Scope):
                self.note_cell(owner, name, AccessKind.WRITE, frame.place(target))
        elif frame.function is None and not scope.parent and frame.qualname == '':
            self.store.write(scope.module, name, value)
            self.note_held(scope.module, name, value)
        else:
            self.store.write(scope, name, value)
            self.note_cell(scope, name, AccessKind.WRITE, frame.place(target))

    def _assign_attribute(self, target: ast.Attribute, value: Value, frame: Frame) -> None:
        owner = self.evaluate(target.value, frame)
        _hint(value, target.attr)
        name = frame.attribute_name(target.attr)
        place = frame.place(target)
        options = owner.options if isinstance(owner, Choice) else (owner,)
        for option in options:
            setters = code_behind.setters_of(self, option, name)
            for setter in setters:
                code_behind.assign(self, setter, value, place)
            if not setters:
                self._store_attribute(option, name, value, place, is_sure=len(options) == 1)

    def set_attribute(self, owner: Value, name: str, value: Value, place: Place) -> None:
        """``object.__setattr__(owner, name, value)``."""
        setters = code_behind.setters_behind(self, owner, name)
        for setter in setters:
            code_behind.assign(self, setter, value, place)
        if not setters:
            self.store_field(owner, name, value, place)

    def store_field(self, owner: Value, name: str, value: Value, place: Place) -> None:
        """``owner.__dict__[name] = value``."""
        self.world.reading.stored = value
        _hint(value, name)
        self._store_attribute(owner, name, value, place, is_sure=True)

    def _store_attribute(
        self, owner: Value, name: str, value: Value, place: Place, *, is_sure: bool
    ) -> None:
        old = getattr(owner, 'slots', {}).get(name)
        self.world.reading.replaced = old
        if old is not None:
            self.note_attribute(owner, name, AccessKind.WRITE, place)
            self.note_replaced(owner, name, old)
        if isinstance(owner, (Instance, Module, Function)) or hasattr(owner, 'mro'):
            self._note_same_unknown(old, value)
            new = value if is_sure or old is None else choice([old, value])
            self.store.write(owner, name, new)  # type: ignore[arg-type]
            self.note_held(owner, name, value)
            self.world.stored.setdefault((owner, name), {})[place] = value
            is_new = self.world.when is not When.START and old != value
            if is_new or self.world.is_beside_others:
                self.world.stored_late.add((owner, name))
        if old is None:
            self.note_attribute(owner, name, AccessKind.WRITE, place)
        if isinstance(owner, (Mystery, Library)):
            whose = owner.text if isinstance(owner, Mystery) else owner.name
            self.note_handed([value], place, f'{whose}.{name}')

    def _note_same_unknown(self, old: Any, new: Value) -> None:
        """One attribute holds one thing: unknown callers pass the same to all methods."""
        if (
            isinstance(old, Mystery)
            and isinstance(new, Mystery)
            and old.lacks_caller
            and new.lacks_caller
            and old.unknown != new.unknown
        ):
            first = self.world.same_unknowns.get(old.unknown, old)
            self.world.same_unknowns.setdefault(new.unknown, first)

    def _assign_item(self, target: ast.Subscript, value: Value, frame: Frame) -> None:
        note_item(self, target.value, target.slice, frame)
        owner = self.evaluate(target.value, frame)
        key = self.evaluate(target.slice, frame)
        note_kept(self.world, value, frame.place(target))
        method = self.special_method(owner, '__setitem__', frame.place(target))
        if method is not None:
            self.call(method, Call(frame.place(target), [key, value]))
            return
        if isinstance(owner, Fields):
            if isinstance(key, Const):
                self.store_field(owner.owner, str(key.value), value, frame.place(target))
            else:
                computed_names.keep(self, owner.owner, key, value, frame.place(target))
            return
        self.world.refilling, self.world.reading.stored = loops.has_key(owner, key), value
        self.note_update(target.value, frame, AccessKind.UPDATE_IN_PLACE)
        self.world.refilling = False
        if isinstance(owner, Mapping):
            if loops.is_key(key):
                _hint(value, loops.key_text(key))
                self.store.write(owner, 'entries', {**owner.entries, key: value})
            else:
                # What was put in last is found again under its key, see ``subscripts.py``.
                others = drawn_together(owner, key)
                many = {known: why for known, why in owner.many.items() if known in others}
                self.store.write(owner, 'entries', {**others, key: value})
                self.store.write(owner, 'many', {**many, key: self.why_many()})
        elif isinstance(owner, Items):
            index = loops.index_of(key, len(owner.items))
            if index is not None:
                items = list(owner.items)
                items[index] = value
                self.store.write(owner, 'items', tuple(items))

    def _unpack(self, targets: Sequence[ast.expr], value: Value, frame: Frame) -> None:
        place = frame.place(targets[0]) if targets else Place('')
        # What is None has no parts: there it raises.
        value = choice([each for each in options_of(value) if each != NONE] or [value])
        items, rest = self.items_of(value, place)
        by_default = items_by_default(value)
        if by_default:
            items, rest = by_default, None
        for index, target in enumerate(targets):
            if isinstance(target, ast.Starred):
                behind = len(targets) - index - 1
                middle = items[index : len(items) - behind]
                self.assign(target.value, Items(middle, 'list', rest), frame)
                items = (*items[:index], NONE, *items[len(items) - behind :])
            elif index < len(items) and not (rest and isinstance(value, Mystery)):
                self.assign(target, items[index], frame)
            else:
                reason = rest.reason if rest else 'too few values to unpack'
                self.assign(target, self.mystery(reason, frame.place(target), target), frame)


def drawn_together(owner: Mapping, key: Value) -> dict[Value, Value]:
    """
    Give the entries without that of ``key``; the oldest of too many unsure keys share one.

    A callback that stores under a key from a message would fill the dictionary forever.
    """
    held = {known: value for known, value in owner.entries.items() if known is not key}
    unsure = [known for known in held if not loops.is_key(known)]
    for oldest, following in pairwise(unsure[: max(0, len(unsure) - MOST_UNSURE) + 1]):
        held[following] = choice([held.pop(oldest), held[following]])
    return held


def _hint(value: Value, name: str) -> None:
    if isinstance(value, Instance) and value.hint is None:
        if isinstance(value.state, PlainState) or name not in ('_', 'self'):
            value.hint = name
    elif isinstance(value, Choice):
        for option in value.options:
            if (
                isinstance(option, Instance)
                and isinstance(option.state, LibraryState)
                and option.state.is_known_by_name
            ):
                _hint(option, name)


def _owner_of(name: str, scope: Scope) -> Scope | Module:
    parent = scope.parent
    while parent is not None:
        if name in parent.slots:
            return parent
        parent = parent.parent
    return scope.module
