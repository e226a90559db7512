"""
Flags by which a callback keeps others out: ``if self.busy: return``, then ``self.busy = True``.

Whoever has found a flag down and put it up holds it, as a lock, until it is put down again; a
done-callback takes over what its maker holds, and the execute callback of an action server what
the goal callback holds wherever it accepts. Whether the test and the setting are one piece, and
nobody else puts the flag down, is for the reader of the accesses to say.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable

from ros2cc_extract.extract.static.machine import Frame, Machine
from ros2cc_extract.extract.static.reading import Reading
from ros2cc_extract.extract.static.values import NONE, Call, Const, Value, options_of
from ros2cc_extract.extract.static.world import EntityState, World
from ros2cc_extract.places import Place
from ros2cc_extract.spec.deeds import FLAG
from ros2cc_extract.spec.model import EntityKind

_THEN, _ELSE, _AFTER = 0, 1, -1
_LEAVING = (ast.Return, ast.Raise, ast.Continue, ast.Break)
_REFUSING = 'REJECT'


def note_test(reading: Reading, node: ast.If, found: Iterable[str], place: Place) -> None:
    """An ``if`` that asks for one flag and nothing else tells where it is down."""
    names = tuple(found)
    asked = _asked(node.test)
    if len(names) != 1 or asked is None or asked[0] != names[0].rpartition('.')[2]:
        return
    flag, down_if = names[0] + FLAG, asked[1]
    if down_if:
        reading.down[place, _THEN] = flag
    elif not node.orelse and isinstance(node.body[-1], _LEAVING):
        reading.down[place, _AFTER] = flag
    elif node.orelse and not isinstance(node.orelse[0], ast.If):
        reading.down[place, _ELSE] = flag


def _asked(test: ast.expr) -> tuple[str, bool] | None:
    """The flag that a test asks for, and what it gives where that is down."""
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = _asked(test.operand)
        return None if inner is None else (inner[0], not inner[1])
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        right, asked = test.comparators[0], _asked(test.left)
        down_if = {ast.Is: True, ast.IsNot: False}.get(type(test.ops[0]))
        is_none = isinstance(right, ast.Constant) and right.value is None
        if asked is None or down_if is None or not is_none or isinstance(test.left, ast.Compare):
            return None
        return asked[0], down_if
    if isinstance(test, ast.Attribute):
        return test.attr, False
    return (test.id, False) if isinstance(test, ast.Name) else None


def put_up(world: World, name: str) -> None:
    """``name`` is stored; who has found it down and stores something holds it from here."""
    flag = name + FLAG
    is_down = any(world.reading.down.get(step) == flag for step in world.path)
    if is_down and flag not in world.held and _is_up(world.reading.stored):
        world.held = (*world.held, flag)


def put_down(world: World, name: str) -> None:
    """``name`` was stored; who has put down its flag holds it no more."""
    stored = world.reading.stored
    if isinstance(stored, Const) and not stored.value:
        world.held = tuple(held for held in world.held if held != name + FLAG)


def _is_up(stored: Value | None) -> bool:
    if stored is None or NONE in options_of(stored):
        return False
    return bool(stored.value) if isinstance(stored, Const) else True


def after_block(before: tuple[str, ...], now: tuple[str, ...]) -> tuple[str, ...]:
    """What is held after a ``with``: its locks are given back, and flags stay as they are."""
    kept = [held for held in before if not held.endswith(FLAG) or held in now]
    return (*kept, *(held for held in now if held.endswith(FLAG) and held not in kept))


def leave(world: World, frame: Frame, *, goes_on: bool) -> None:
    """A function ends: a flag that it holds on some ways out only is not held for certain."""
    ways = [held for held, _ in frame.left]
    world.held = _by_all(world.held, ways)
    accepting = [held for held, refuses in frame.left if not refuses]
    accepting += [world.held] if goes_on else []
    world.accepted = _by_all(accepting[0], accepting) if accepting else ()


def _by_all(held: tuple[str, ...], ways: Iterable[tuple[str, ...]]) -> tuple[str, ...]:
    ways = tuple(ways)
    return tuple(
        lock for lock in held if not lock.endswith(FLAG) or all(lock in way for way in ways)
    )


def note_return(world: World, frame: Frame, node: ast.Return) -> None:
    """One way out of a function, and whether it turns a goal down."""
    refuses = isinstance(node.value, ast.Attribute) and node.value.attr == _REFUSING
    frame.left.append((world.held, refuses))


def hand_over(world: World, to: EntityState) -> None:
    """What a callback makes runs after it, and holds what it holds."""
    if world.deeds is not None:
        held = tuple(lock for lock in world.held if lock.endswith(FLAG))
        to.held = held if to.held is None else tuple(lock for lock in to.held if lock in held)
        world.held = tuple(lock for lock in world.held if lock not in held)


def call(machine: Machine, entity: EntityState, callback: Value, arguments: Call) -> Value:
    """Call what an entity runs, holding what was handed over to it."""
    world = machine.world
    served = (entity.node, entity.place)
    if entity.kind is EntityKind.ACTION_EXECUTE:
        world.held = world.admitted.get(served, ())
    else:
        world.held = entity.held or ()
    result = machine.call(callback, arguments)
    if callback in options_of(entity.goal_callback or NONE):
        world.admitted[served] = tuple(held for held in world.accepted if held.endswith(FLAG))
    return result
