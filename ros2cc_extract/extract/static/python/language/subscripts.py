"""Items of sequences, dictionaries and objects."""

from __future__ import annotations

import ast
from dataclasses import replace
from functools import partial

from ros2cc_extract.extract.static.python.builtins import builtin_methods
from ros2cc_extract.extract.static.python.language.try_blocks import is_lack_uncaught
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import RECENT, AccessKind
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.objects.element_keys import note_item
from ros2cc_extract.extract.static.python.values import constant_folding
from ros2cc_extract.extract.static.python.values.assumed_defaults import (
    default_of,
    items_by_default,
)
from ros2cc_extract.extract.static.python.values.containers import Fields, Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Choice,
    Class,
    Const,
    Function,
    Instance,
    Library,
    Mystery,
    Partial,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import ADDS, BY_INDEX, BY_KEY, COPIED


def subscript(machine: Machine, node: ast.Subscript, frame: Frame) -> Value:
    """``owner[key]``, for every owner that is possible."""
    at = frame.place(node.value)
    note_item(machine, node.value, node.slice, frame)
    machine.world.reading.note_use(node.value, at)
    owner = machine.evaluate(node.value, frame)
    key = machine.evaluate(node.slice, frame)
    _note_filled(machine, owner, key, node, frame)
    _note_lookup(machine, owner, node, at)
    if _is_whole(node.slice):
        machine.note_iteration(node.value, frame, COPIED)
    place = frame.place(node)
    found = choice(
        [_item(machine, option, key, node, frame) for option in options_of(owner)]
        or [machine.mystery('item that could not be followed', place, node)]
    )
    return choice(list(options_of(found))) if isinstance(found, Choice) else found


def _is_whole(key: ast.expr) -> bool:
    """``rows[:]``."""
    return isinstance(key, ast.Slice) and key.lower is None and key.upper is None


def _note_filled(
    machine: Machine, owner: Value, key: Value, node: ast.Subscript, frame: Frame
) -> None:
    """Reading a key may add it: ``collections.defaultdict``."""
    world = machine.world
    if world.effects is not None and any(_may_fill(each, key) for each in options_of(owner)):
        world.moves = ADDS
        machine.note_update(node.value, frame, AccessKind.UPDATE_IN_PLACE)
        world.moves = None


def _note_lookup(machine: Machine, owner: Value, node: ast.Subscript, at: Place) -> None:
    """
    Mark the read of a collection for an item that a look at it has found before.

    It was found by a test, or the key comes from there: ``for k in list(d): use(d[k])``.
    """
    kinds = {type(each) for each in options_of(owner)}
    how = BY_KEY if kinds == {Mapping} else BY_INDEX if kinds == {Sequence} else None
    effects, reading = machine.world.effects, machine.world.reading
    is_item = how is not None and not isinstance(node.slice, ast.Slice)
    if effects is None or not is_item or not isinstance(node.value, ast.Attribute):
        return
    name = node.value.attr
    for number in range(len(effects.reads) - 1, max(len(effects.reads) - RECENT, 0) - 1, -1):
        read = effects.reads[number]
        if (read.source, read.name.rpartition('.')[2]) == (at, name) and read.iterates is None:
            is_key = read.name in reading.choices.get((at, name), ())
            if (read.rests or is_key) and is_lack_uncaught(machine):
                # Where a key is taken from, others are let in: at a call, or as the loop goes on.
                later = read.later or is_key
                effects.reads[number] = replace(read, looks_up=how, later=later)
            return


def _may_fill(owner: Value, key: Value) -> bool:
    return isinstance(owner, Mapping) and owner.fills and not loops.has_key(owner, key)


def _item(machine: Machine, owner: Value, key: Value, node: ast.Subscript, frame: Frame) -> Value:
    place = frame.place(node)
    if isinstance(owner, Mapping):
        if key in owner.entries if loops.is_key(key) else False:
            machine.world.note_apart(owner.entries[key], owner.entries.values())
            return owner.entries[key]
        if isinstance(key, Mystery) and next(reversed(owner.entries), None) is key:
            return owner.entries[key]
        one_of_all = None if loops.is_key(key) else loops.any_of(owner)
        if owner.fills:
            _make_missing(machine, owner, node, frame)
        reason = owner.rest.reason if owner.rest else 'key that could not be followed'
        return one_of_all or machine.mystery(reason, place, node)
    if isinstance(owner, Sequence):
        if isinstance(node.slice, ast.Slice):
            return _slice(machine, owner, node.slice, frame)
        index = loops.index_of(key, len(owner.items))
        if index is not None and owner.rest is None:
            machine.world.note_apart(owner.items[index], owner.items)
            return owner.items[index]
        if index is not None and owner.others is None and key == Const(-1):
            return owner.items[-1]  # it was put in last
        one_of_all = loops.any_of(owner) if index is None else None
        return one_of_all or machine.mystery('index that could not be followed', place, node)
    if isinstance(owner, Const) and isinstance(key, Const):
        return constant_folding.subscript(owner, key) or machine.mystery('bad subscript', place)
    if isinstance(owner, (Class, Library)):
        return owner
    if isinstance(owner, Fields):
        held = builtin_methods.field(machine, owner, key, place)
        return held or machine.mystery('attribute that could not be followed', place, node)
    if isinstance(owner, Instance) and isinstance(owner.cls, Class):
        method = machine.attribute(owner, '__getitem__', place)
        if isinstance(method, Bound):
            return machine.call(method, Call(place, [key]))
        missing = machine.special_method(owner, '__missing__', place)
        if missing is not None:
            asked = partial(machine.call, missing, Call(place, [key]))
            known = machine.mystery('item that was there before', place, node)
            return machine.branch([asked, lambda: known], place)
    by_default = items_by_default(owner)
    index = loops.index_of(default_of(key) or key, len(by_default))
    if by_default and index is not None:
        return by_default[index]
    reason = owner.unknown.reason if isinstance(owner, Mystery) else 'item of an unknown value'
    return machine.mystery(reason, place, node)


def _make_missing(machine: Machine, owner: Mapping, node: ast.Subscript, frame: Frame) -> None:
    """``collections.defaultdict``: a function of the program may be asked for the item."""
    factory = owner.slots.get('factory')
    if isinstance(factory, (Function, Bound, Partial)):
        place = frame.place(node)
        machine.branch([lambda: machine.call(factory, Call(place)), lambda: NONE], place)


def _slice(machine: Machine, owner: Sequence, node: ast.Slice, frame: Frame) -> Value:
    bounds: list[int | None] = []
    for part in (node.lower, node.upper, node.step):
        value = machine.evaluate(part, frame) if part is not None else NONE
        if not isinstance(value, Const) or not isinstance(value.value, (int, type(None))):
            rest = Unknown('slice that could not be followed', frame.place(node))
            return Sequence((), owner.kind, rest)
        bounds.append(value.value)
    if bounds[2] == 0:
        return machine.mystery('slice step zero', frame.place(node))
    return Sequence(owner.items[slice(*bounds)], owner.kind, owner.others, owner.many)


def slice_alone(machine: Machine, node: ast.Slice, frame: Frame) -> Value:
    """A slice that is no index of a known sequence."""
    return machine.mystery('slice', frame.place(node))
