"""
What a callback holds from its begin: flags that its maker has handed over to it.

The execute callback of an action server holds what the goal callback holds wherever it accepts;
where that has only found a flag down, the execute callback may put it up. A done-callback takes
over a flag that its text may put down; any other stays with its maker.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.accesses.flags.flag_locks import has_waited
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.objects.reachable_texts import reachable
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Function,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.spec.effects import FLAG
from ros2cc_extract.spec.model import EntityKind


def call_holding(
    machine: RosMachine, entity: EntityState, callback: Value, arguments: Call
) -> Value:
    """Call what an entity runs, holding what was handed over to it."""
    world = machine.world
    served = (entity.node, entity.place)
    world.still_down = frozenset()
    if entity.kind is EntityKind.ACTION_EXECUTE:
        world.held = world.admitted.get(served, ())
        world.still_down = world.open_to.get(served, frozenset())
    else:
        world.held = (*(entity.held or ()), *_held_by_caller(machine, entity, callback))
    result = machine.run_if_coroutine(machine.call(callback, arguments), entity.place)
    if callback in options_of(entity.goal_callback or NONE):
        _note_admission(world)
        world.admitted[served] = tuple(held for held in world.accepted if held.endswith(FLAG))
        is_one_piece = not entity.defers and not has_waited(world)
        world.open_to[served] = world.found_down if is_one_piece else frozenset()
    return result


def _held_by_caller(machine: RosMachine, entity: EntityState, callback: Value) -> Iterator[str]:
    """The lock that a library holds while it calls ``callback``."""
    for given, lock in entity.called_under.items():
        if lock is not None and callback in options_of(given):
            yield machine.lock_name(lock, 'lock')


def _note_admission(world: RosWorld) -> None:
    """What the goal callback has read, and turned goals down for."""
    effects, names = world.effects, world.reading.refusing
    if effects is not None and names:
        effects.reads[:] = [replace(r, admits=r.name in names) for r in effects.reads]


def hand_over(world: RosWorld, to: EntityState) -> None:
    """
    What a callback makes runs after it, and holds the flags that it may put down.

    The names in its text decide. Where they mislead, a flag is stored by code that does not
    hold it, and counts as no lock.
    """
    if world.effects is not None:
        texts = [_text_of(run) for run in _runs(to)]
        stored = {name for text in texts if text is not None for name in _stored(world, text)}
        held = tuple(
            lock
            for lock in world.held
            if lock.endswith(FLAG) and (None in texts or _attribute_of(lock) in stored)
        )
        to.held = held if to.held is None else tuple(lock for lock in to.held if lock in held)
        world.held = tuple(lock for lock in world.held if lock not in held)


def _attribute_of(flag: str) -> str:
    return flag.removesuffix(FLAG).rpartition('.')[2]


def _runs(entity: EntityState) -> Iterator[Value]:
    for given in (entity.callback, *entity.extra_callbacks):
        yield from options_of(given or NONE)


def _text_of(run: Value) -> ast.AST | None:
    """The function that is run, as far as it is one of the program."""
    called = run.function if isinstance(run, Partial) else run
    function = called.function if isinstance(called, Bound) else called
    return function.node if isinstance(function, Function) else None


def _stored(world: RosWorld, text: ast.AST) -> Iterator[str]:
    """The names that ``text``, or what it leads to by name, stores to."""
    for node in reachable(world, text):
        yield from noted_on(node, 'stored_names', _stored_names)


def _stored_names(node: ast.AST) -> frozenset[str]:
    stored = [part for part in walk(node) if isinstance(getattr(part, 'ctx', None), ast.Store)]
    attributes = {part.attr for part in stored if isinstance(part, ast.Attribute)}
    return frozenset(attributes | {part.id for part in stored if isinstance(part, ast.Name)})
