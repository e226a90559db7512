"""
What functions do that code which is not scanned has: a broker's client, a web server, a listener.

Such code may call them on a thread of its own. They are followed when all else is known, only for
the data that they touch; nothing else that they do changes what is known.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.python.values.unknown_callers import unknown_arguments
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Function,
    Partial,
    Value,
)
from ros2cc_extract.extract.static.scan.callback_runs import MOST_CALLBACKS
from ros2cc_extract.extract.static.scan.guarded_runs import guarded
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter
from ros2cc_extract.extract.static.scan.texts_that_act import may_make_entities
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import BY_CALLBACK, BY_NAME
from ros2cc_extract.spec.model import ActivityKind, When

_CONTAINERS = (list, dict, set)


def follow_handed(machine: RosInterpreter) -> None:
    """Follow each of them once, unless code of the program calls it too or it makes entities."""
    for value, function, place, name in _handed(machine):
        skip = 1 if isinstance(value, Bound) else 0
        is_partial = isinstance(value, Partial)
        call = Call(place) if is_partial else unknown_arguments(function, place, skip)
        state = ActivityState(ActivityKind.THREAD, place, value, call)
        _follow(machine, state)
        machine.world.handed_on.append((state, name))


def _handed(machine: RosInterpreter) -> Iterator[tuple[Value, Function, Place, str]]:
    seen = set[tuple[int, int]]()
    for value, place, name in machine.world.handed[:MOST_CALLBACKS]:
        inner = value
        while isinstance(inner, Partial):
            inner = inner.function
        function = inner.function if isinstance(inner, Bound) else inner
        receiver = inner.receiver if isinstance(inner, Bound) else None
        if not isinstance(function, Function) or (id(function.node), id(receiver)) in seen:
            continue
        seen.add((id(function.node), id(receiver)))
        is_by_name = name.endswith((BY_NAME, BY_CALLBACK))
        if (is_by_name or _lacks_caller(machine, function)) and not may_make_entities(
            machine.world, function.node
        ):
            yield value, function, place, name


def _lacks_caller(machine: RosInterpreter, function: Function) -> bool:
    """Whether no code of the program calls it; what was followed all the same may be."""
    world, number = machine.world, id(function.node)
    is_followed = number in world.without_caller or number in world.escaped_to_unknown
    return number not in world.called or is_followed


def _follow(machine: RosInterpreter, state: ActivityState) -> None:
    world = machine.world
    kept = _contents(world)

    def follow() -> None:
        world.activity, world.effects, world.current = state, state.effects, None
        world.when, world.count = When.CALLBACK, 1
        world.again = world.second_pass = world.only_data = True
        world.after_spin = False
        world.asked, world.ready = set(), frozenset()
        mark = machine.store.open_branch()
        if state.target is not None and state.call is not None:
            machine.run_if_coroutine(machine.call(state.target, state.call), state.place)
        machine.store.close_branch(mark)

    guarded(machine, follow, state.place)
    world.only_data = False
    _put_back(kept)


def _contents(world: Any) -> list[tuple[Any, Any]]:
    """The lists, dictionaries and sets of ``world``, each with what is in it now."""
    held = [each for each in vars(world).values() if isinstance(each, _CONTAINERS)]
    inner = [
        each
        for thing in held
        if isinstance(thing, dict)
        for each in thing.values()
        if isinstance(each, _CONTAINERS)
    ]
    return [(each, each.copy()) for each in (*held, *inner)]


def _put_back(kept: list[tuple[Any, Any]]) -> None:
    for thing, content in kept:
        if isinstance(thing, list):
            thing[:] = content
        else:
            thing.clear()
            thing.update(content)
