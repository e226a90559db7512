"""
Which nodes are one, and which entities: what is made only if it does not exist yet is made once.

A test such as ``if node is None`` cannot be decided in a callback, nor in code with an unknown
caller. What such code makes at one place, with the same arguments, is one node; else a
callback that asks for its node would make another one, whose callbacks would make another one.
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Class,
    Const,
    Instance,
    Library,
    Mystery,
    Value,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import When

_MADE = '__made__'
_AFTER_AN_OPEN_TEST = -1


def made_before(machine: Machine, cls: Class | Library, call: Call) -> Instance | None:
    """The node that this call would make again, as far as this branch knows of it."""
    world = machine.world
    if not world.made_in_callbacks or (world.when is When.START and world.is_program):
        return None
    known = world.made_in_callbacks.get(_site(cls, call))
    if known is None or _MADE not in known.slots:
        return None
    is_open = bool(world.path) and world.path[-1][1] >= _AFTER_AN_OPEN_TEST
    is_made_by_itself = world.current is not None and world.current.owner is known
    return known if is_open or is_made_by_itself else None


def note_open_test(world: World, test: ast.expr, place: Place) -> None:
    """Keep in mind what asks whether something is there yet."""
    if isinstance(test, ast.UnaryOp):
        asks = isinstance(test.op, ast.Not)
    else:
        asks = isinstance(test, ast.Compare) and isinstance(
            test.ops[0], (ast.Is, ast.IsNot, ast.In, ast.NotIn)
        )
    if asks:
        world.missing.add(place)


def remember(machine: Machine, instance: Instance, call: Call) -> None:
    """Keep ``instance`` for ``made_before``, if it is a node."""
    if isinstance(instance.state, LibraryState) and instance.state.is_made_once:
        machine.world.made_in_callbacks[_site(instance.cls, call)] = instance
        machine.store.write(instance, _MADE, NONE)


def _site(cls: Class | Library, call: Call) -> object:
    arguments = [*enumerate(call.args), *call.keywords.items()]
    return (cls, call.place, tuple((name, argument_token(value)) for name, value in arguments))


def argument_token(value: Value | None) -> object:
    """Equal for arguments that are the same each time; a new library object counts as that."""
    if isinstance(value, Const):
        return value
    if isinstance(value, Mystery):
        return (value.text, value.unknown)
    if isinstance(value, Instance) and isinstance(value.cls, Library):
        return value.cls
    return id(value)
