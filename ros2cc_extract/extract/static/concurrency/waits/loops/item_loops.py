"""
Loops that take from a queue until one certain item comes: ``while True: if queue.get() is None``.

Not every item ends such a loop. Of its tests the same small formula is kept as of a loop on plain
data, in which the item stands for itself; ``machine/item_values.py`` asks it for each thing that
is put in.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.item_values import ITEM, Thing
from ros2cc_extract.extract.static.concurrency.machine.loop_formulas import Formula, LoopTest
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_ends import (
    evaluated,
    exits_of,
    seen_by,
)
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import own_parts
from ros2cc_extract.extract.static.concurrency.waits.loops.values_that_stay import stays_if
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.dependences import constant_key
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Const, Instance
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import WORKING_LOOP, Blocking, Needs
from ros2cc_extract.spec.model import ActivityKind

_TAKES = frozenset({'Queue.get', 'asyncio.Queue.get', 'await asyncio.Queue.get'})
Parts = Mapping[str, str | None]
"""The names that stand for an item, or for a part of it; ``None`` for all of it."""


def note(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> bool:
    """
    Note which items end ``loop``, if it ends by nothing else; whether that is so.

    A thread works in its rounds, and waits for that item only at their end.
    """
    effects = machine.world.effects
    assert effects is not None
    taken = _taken(effects, loop, frame)
    if taken is None:
        return False
    number, parts = taken
    tests = exits_of(machine, loop, frame)
    if not tests or not all(_asks_item(test, parts) for test in tests):
        return False
    block = effects.blocking[number]
    until = tuple(
        LoopTest(_formula(machine, test, parts, frame), stays_if=stays_if(test, loop))
        for test in tests
    )
    reference = block.resource
    assert isinstance(reference, ResourceRef)
    activity = machine.world.activity
    if activity is None or activity.kind is ActivityKind.MAIN:
        reference.until = until
        return True
    _note_end(effects, block, reference.with_end(until), frame.place(loop))
    return True


def _note_end(effects: EffectLog, block: Blocking, until: ResourceRef, place: Place) -> None:
    end = replace(block, call=WORKING_LOOP, needs=Needs.ONCE, resource=until, source=place)
    effects.blocking.append(end)


def _taken(effects: EffectLog, loop: ast.While, frame: Frame) -> tuple[int, Parts] | None:
    """The one wait of each round for an item, and the names that the round gives to it."""
    found = [
        (number, parts)
        for number, block in enumerate(effects.blocking)
        if block.call in _TAKES and block.seconds is None and _is_of_one(block)
        for call, parts in _given(loop)
        if frame.place(call) == block.source
    ]
    return found[0] if len(found) == 1 else None


def _is_of_one(block: Blocking) -> bool:
    return isinstance(block.resource, ResourceRef) and block.resource.ended_by == {Word.PUT}


def _given(loop: ast.While) -> list[tuple[ast.Call, Parts]]:
    """The calls whose result gets names in each round."""
    found = []
    for part in (*walk(loop.test), *own_parts(loop.body)):
        if isinstance(part, ast.Assign) and len(part.targets) == 1:
            target, value = part.targets[0], part.value
        elif isinstance(part, ast.NamedExpr):
            target, value = part.target, part.value
        else:
            continue
        value = value.value if isinstance(value, ast.Await) else value
        names = _names(target)
        if isinstance(value, ast.Call) and names:
            found.append((value, names))
    return found


def _names(target: ast.expr) -> Parts:
    if isinstance(target, ast.Name):
        return {target.id: None}
    items = target.elts if isinstance(target, (ast.Tuple, ast.List)) else []
    return {each.id: repr(n) for n, each in enumerate(items) if isinstance(each, ast.Name)}


def _asks_item(test: ast.expr, parts: Parts) -> bool:
    return any(isinstance(each, ast.Name) and each.id in parts for each in walk(test))


def _formula(machine: ConcurrentMachine, node: ast.expr, parts: Parts, frame: Frame) -> Formula:
    if isinstance(node, ast.NamedExpr):
        return _formula(machine, node.target, parts, frame)
    if isinstance(node, ast.Name) and node.id in parts:
        return Formula('asked', name=ITEM, item=parts[node.id])
    if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name):
        key = constant_key(node.slice)
        if key is not None and parts.get(node.value.id, '') is None:
            return Formula('asked', name=ITEM, item=key)
    if not _asks_item(node, parts):
        return _constant(machine, node, frame)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return Formula('not', (_formula(machine, node.operand, parts, frame),))
    if isinstance(node, ast.BoolOp):
        kind = 'and' if isinstance(node.op, ast.And) else 'or'
        return Formula(kind, tuple(_formula(machine, e, parts, frame) for e in node.values))
    compared = _COMPARED.get(type(node.ops[0])) if isinstance(node, ast.Compare) else None
    if isinstance(node, ast.Compare) and compared is not None and len(node.ops) == 1:
        sides = (node.left, node.comparators[0])
        return Formula(
            'compared', tuple(_formula(machine, e, parts, frame) for e in sides), value=compared
        )
    return Formula('open', node=node)


def _constant(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> Formula:
    """What each round finds alike: a constant or an object, and no data that others may change."""
    options = evaluated(machine, node, frame)
    value = options[0] if len(options) == 1 else None
    if isinstance(value, Const) and not seen_by(machine, [node], frame).names:
        return Formula('constant', value=value.value)
    if isinstance(value, Instance):
        return Formula('constant', value=Thing(value))
    return Formula('open', node=node)


def _is(left: object, right: object) -> bool:
    if isinstance(left, Thing) and isinstance(right, Thing):
        return left.is_for_sure(right)
    return left is right


def _equals(left: object, right: object) -> bool:
    if left is None or right is None:
        return left is right  # no type of ROS, nor of the standard library, equals None
    if isinstance(left, Thing) or isinstance(right, Thing):
        raise TypeError('how these compare is not known')
    return left == right


_COMPARED = {
    ast.Is: _is,
    ast.IsNot: lambda left, right: not _is(left, right),
    ast.Eq: _equals,
    ast.NotEq: lambda left, right: not _equals(left, right),
}
