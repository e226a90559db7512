"""
Threads that run one at a time, as each begins only when the one before has ended.

``if self.worker is not None and self.worker.is_alive(): return``, and then a new thread is stored
there and started. Test and start must be in one piece: under one lock, or in callbacks
of one exclusive group, which ``units/threads_in_turn.py`` knows.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.concurrency.accesses.flags.flag_locks import steps_of
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import (
    ActivityState,
    ConcurrentWorld,
    Holds,
    ThreadState,
)
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.library_state import BESIDE
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Instance,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import FLAG
from ros2cc_extract.spec.model import When


def note_test(machine: ConcurrentMachine, node: ast.If, place: Place, frame: Frame) -> None:
    """Note where an ``if`` shows that the thread of an attribute is not alive."""
    world, steps = machine.world, steps_of(node)
    if world.effects is None:
        return
    for attribute, ended_if in _ended(node.test):
        with world.reading.apart():
            noted, world.effects = world.effects, None
            owner = machine.evaluate(attribute.value, frame)
            world.effects = noted
        if isinstance(owner, Instance):
            for step in steps[ended_if]:
                found = world.ended.setdefault((place, step), {})
                found[owner, frame.attribute_name(attribute.attr)] = _holds(world)


def _ended(test: ast.expr) -> Iterator[tuple[ast.Attribute, bool]]:
    """The attributes whose thread has ended where all of ``test`` holds, or nothing of it."""
    asked = _asked(test)
    if asked is not None:
        yield asked[0], not asked[1]
    elif isinstance(test, ast.BoolOp):
        ended_if = isinstance(test.op, ast.And)
        parts = (each for value in test.values for each in _ended(value))
        yield from (each for each in parts if each[1] is ended_if)


def _asked(test: ast.expr) -> tuple[ast.Attribute, bool] | None:
    """The attribute whose thread a test asks for, if there is one, and its answer if alive."""
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = _asked(test.operand)
        return None if inner is None else (inner[0], not inner[1])
    if isinstance(test, ast.BoolOp):
        last, is_and = _asked(test.values[-1]), isinstance(test.op, ast.And)
        if last is None or last[1] is not is_and:
            return None
        is_plain = all(_is_there(part, last[0]) is is_and for part in test.values[:-1])
        return last if is_plain else None
    function = test.func if isinstance(test, ast.Call) else None
    is_asked = isinstance(function, ast.Attribute) and function.attr == 'is_alive'
    if not is_asked or not isinstance(function.value, ast.Attribute):  # type: ignore[union-attr]
        return None
    return function.value, True  # type: ignore[union-attr]


def _is_there(test: ast.expr, attribute: ast.Attribute) -> bool | None:
    """What a test gives if the attribute holds something; ``None`` if it asks for more."""
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = _is_there(test.operand, attribute)
        return None if inner is None else not inner
    is_there = True
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        right, op = test.comparators[0], test.ops[0]
        is_none = isinstance(right, ast.Constant) and right.value is None
        if not is_none or not isinstance(op, (ast.Is, ast.IsNot)):
            return None
        test, is_there = test.left, isinstance(op, ast.IsNot)
    return is_there if ast.dump(test) == ast.dump(attribute) else None


def note_stored(world: ConcurrentWorld, owner: Value, name: str, value: Value) -> None:
    """A thread is stored in an attribute, or nothing: the one that was there is known no more."""
    options = options_of(value)
    if not isinstance(owner, Instance) or not any(map(_is_thread_or_none, options)):
        return
    kept = owner, name
    found = [world.ended.get(step, {}) for step in world.reading.behind(world.path)]
    holds = next((each[kept] for each in reversed(found) if kept in each), None)
    own = world.activity.alone if world.activity is not None else None
    if world.activity is not None and value == NONE:
        world.activity.left.add(kept)
    if holds is not None and world.effects is not None:
        world.claims[kept] = value, holds
    elif not (kept in (own or {}) and value == NONE) and not _is_of_set_up(world, value):
        world.unguarded.add(kept)


def note_goes_on(world: ConcurrentWorld) -> None:
    """A thread that has taken itself out of sight goes on all the same."""
    if world.activity is not None:
        world.unguarded |= world.activity.left


def _is_thread_or_none(option: Value) -> bool:
    state = option.slots.get(BESIDE, option.state) if isinstance(option, Instance) else None
    return option == NONE or isinstance(state, ThreadState)


def _is_of_set_up(world: ConcurrentWorld, value: Value) -> bool:
    """Nothing is there before anything runs, and nothing matters after it."""
    return world.effects is None and world.when is not When.LATER and value == NONE


def note_begun(world: ConcurrentWorld, state: ActivityState, runner: Value | None) -> None:
    """Note a started thread, and whether a test showed first that the one before has ended."""
    now = _holds(world)
    starts = {
        kept: (world.activity or world.current, frozenset(holds.items() & now.items()))
        for kept, (stored, holds) in world.claims.items()
        if runner is not None and runner in options_of(stored)
    }
    before = state.alone
    state.alone = {
        kept: (*(before or {}).get(kept, ()), start)
        for kept, start in starts.items()
        if before is None or kept in before
    }


def _holds(world: ConcurrentWorld) -> Holds:
    """The locks that are held, each with the number of its hold."""
    locks = (lock for lock in world.held if not lock.endswith(FLAG))
    return {lock: world.holds.get(lock, 0) for lock in locks}
