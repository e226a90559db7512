"""
Objects that are changed piece by piece and read as a whole, as a message or an array is.

``self.state.position[wheel] = x`` leaves ``self.state`` the same object. ``publish(self.state)``
copies all its fields at once under the global lock of CPython (rclpy 7.1.6 and 9.1.2,
``publisher.py``; generated ``*_s.c`` of the message packages), so that a message is torn where
another thread stands between two changes. Functions of NumPy go over an array in C, and so on
the same terms. An object that is made anew each time does not count.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.concurrency.accesses import collection_aliases
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.program.text_queries import noted_on, unmangled, walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.recorded_effects import Piece
from ros2cc_extract.extract.static.python.machine.world import RECENT
from ros2cc_extract.extract.static.python.values.values import (
    Class,
    Instance,
    Library,
    Mystery,
    Native,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access

_SENDS = 'publish'
_ARRAYS = 'numpy.'
_DEPTH = 8


def note_changed(
    machine: ConcurrentMachine, target: ast.expr, frame: Frame, how: str = ''
) -> None:
    """An attribute or item of an object is stored, or a collection in it changes in place."""
    if machine.world.effects is None or not isinstance(target, (ast.Attribute, ast.Subscript)):
        return
    whole = _whole(machine, target.value, frame)
    if whole is not None:
        again = _goes_over_items(target, frame)
        _note(machine, whole, frame.place(target), ast.unparse(target) + how, again=again)


def note_sent(machine: ConcurrentMachine, function: Value, node: ast.Call, frame: Frame) -> None:
    """``publisher.publish(self.state)``, ``self.grid.sum()``: all of the object is read."""
    if machine.world.effects is None:
        return
    for read in _read_whole(machine, function, node, frame):
        whole = _object(machine, read, frame)
        if whole is not None:
            _note(machine, whole, frame.place(node), '')


def _read_whole(
    machine: ConcurrentMachine, function: Value, node: ast.Call, frame: Frame
) -> Iterator[ast.expr]:
    """What a call publishes, and the arrays that code which is not followed gets or has."""
    is_sent = isinstance(function, Native) and function.name.rpartition('.')[2] == _SENDS
    if is_sent and len(node.args) == 1:
        yield node.args[0]
    elif isinstance(function, (Mystery, Library)):
        own = [node.func.value] if isinstance(node.func, ast.Attribute) else []
        parts = [part for part in (*own, *node.args) if _is_held(part)]
        for part in parts:
            values = options_of(_evaluated(machine, part, frame))
            if any(isinstance(v, Mystery) and v.text.startswith(_ARRAYS) for v in values):
                yield part


def note_held(
    world: ConcurrentWorld, owner: Instance, attribute: str, value: Value, shown: str
) -> None:
    """An attribute holds an object for good, by which it is known under other names."""
    if isinstance(value, Mystery) and not collection_aliases.is_reassigned(owner, attribute):
        world.objects.setdefault(value, shown)


def _is_held(node: ast.expr) -> bool:
    """A name, or an attribute of one: to ask for its value runs nothing."""
    return isinstance(node, ast.Name) or (isinstance(node, ast.Attribute) and _is_held(node.value))


def _note(
    machine: ConcurrentMachine, whole: str, place: Place, part: str, *, again: bool = False
) -> None:
    world, effects = machine.world, machine.world.effects
    assert effects is not None
    access = Access(
        name=whole,
        source=place,
        locks=world.held,
        update=bool(part),
        in_place=bool(part),
        chain=world.chain[1:],
    )
    world.note_done(whole, place)
    piece = Piece(access, part, world.path, again)
    if piece not in effects.pieces[-RECENT:]:
        effects.pieces.append(piece)


def _object(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> str | None:
    """The attribute that holds the object of ``node``."""
    if isinstance(node, ast.Attribute):
        return _attribute(machine, node, frame)
    if isinstance(node, ast.Name):
        named = _alias(node, frame)
        if isinstance(named, ast.Attribute):
            return _attribute(machine, named, frame)
        return _known(machine, node, frame)
    return None


def _whole(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> str | None:
    """The attribute that holds the object of ``node``, or a whole that it is part of."""
    for _ in range(_DEPTH):
        if isinstance(node, ast.Subscript):
            node = node.value
        elif isinstance(node, ast.Attribute):
            found = _attribute(machine, node, frame)
            if found is not None:
                return found
            node = node.value
        elif isinstance(node, ast.Name):
            named = _alias(node, frame)
            if named is None:
                return _known(machine, node, frame)
            node = named
        else:
            return None
    return None


def _attribute(machine: ConcurrentMachine, node: ast.Attribute, frame: Frame) -> str | None:
    """``Class.attribute`` of an object of the program, where another kind of object is in it."""
    for owner in options_of(_evaluated(machine, node.value, frame)):
        if isinstance(owner, Instance) and isinstance(owner.cls, Class):
            held = owner.slots.get(frame.attribute_name(node.attr))
            options = options_of(held) if isinstance(held, Value) else ()
            is_own = owner.born is machine.world.effects
            if not is_own and any(isinstance(option, Mystery) for option in options):
                name = unmangled(frame.attribute_name(node.attr), owner.cls.name)
                return f'{collection_aliases.object_name(owner, owner.cls)}.{name}'
    return None


def _known(machine: ConcurrentMachine, node: ast.Name, frame: Frame) -> str | None:
    if not machine.world.objects or not isinstance(node.ctx, ast.Load):
        return None
    values = options_of(_evaluated(machine, node, frame))
    return next((machine.world.objects[v] for v in values if v in machine.world.objects), None)


def _evaluated(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> Value:
    noted, machine.world.effects = machine.world.effects, None
    before = machine.world.changing
    try:
        with machine.world.reading.apart():
            return machine.evaluate(node, frame)
    finally:
        machine.world.effects, machine.world.changing = noted, before


def _alias(node: ast.Name, frame: Frame) -> ast.expr | None:
    """What a local variable is another name for, where it is assigned once."""
    if frame.function is None:
        return None
    return noted_on(frame.function.node, 'aliases', _aliases).get(node.id)


def _aliases(function: ast.AST) -> dict[str, ast.expr]:
    """
    Names that are assigned once, an attribute or an item of something.

    Not so where that attribute gets another object there: ``old = self.msg; self.msg = Msg()``.
    """
    parts = list(walk(function))
    stored = [part.id for part in parts if _is_stored(part) and isinstance(part, ast.Name)]
    anew = {part.attr for part in parts if _is_stored(part) and isinstance(part, ast.Attribute)}
    return {
        part.targets[0].id: part.value
        for part in parts
        if isinstance(part, ast.Assign)
        and len(part.targets) == 1
        and isinstance(part.targets[0], ast.Name)
        and isinstance(part.value, (ast.Attribute, ast.Subscript))
        and stored.count(part.targets[0].id) == 1
        and anew.isdisjoint(_attributes(part.value))
    }


def _is_stored(part: ast.AST) -> bool:
    return isinstance(getattr(part, 'ctx', None), (ast.Store, ast.Del))


def _attributes(node: ast.expr) -> Iterator[str]:
    return (part.attr for part in ast.walk(node) if isinstance(part, ast.Attribute))


def _goes_over_items(target: ast.Attribute | ast.Subscript, frame: Frame) -> bool:
    """Whether a loop of the function stores one item after the other: ``msg.data[k] = …``."""
    if frame.function is None:
        return False
    keys = {
        name.id
        for part in ast.walk(target)
        if isinstance(part, ast.Subscript)
        for name in ast.walk(part.slice)
        if isinstance(name, ast.Name)
    }
    return not keys.isdisjoint(noted_on(frame.function.node, 'loop_names', _loop_names))


def _loop_names(function: ast.AST) -> frozenset[str]:
    return frozenset(
        name.id
        for part in walk(function)
        if isinstance(part, ast.For)
        for name in ast.walk(part.target)
        if isinstance(name, ast.Name)
    )
