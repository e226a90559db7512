"""
What functions do that code which is not scanned has: a broker's client, a web server, a listener.

Such code may call them on a thread of its own. They are followed when all else is known, only for
the data that they touch; nothing else that they do changes what is known.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import nullcontext
from typing import Any

from ros2cc_extract.extract.static.concurrency.accesses.web_servers import (
    answers,
    is_called_once,
)
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.waits.loop_tasks import LoopTask, as_root
from ros2cc_extract.extract.static.libraries.qt.handlers import handlers_of
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
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
    """
    Follow each of them once, unless code of the program calls it too.

    Nor one that makes entities, which have not been followed as such.
    """
    for value, function, place, name, whose in _handed(machine):
        skip = 1 if isinstance(value, Bound) else 0
        is_partial = isinstance(value, Partial)
        call = Call(place) if is_partial else unknown_arguments(function, place, skip)
        state = ActivityState(ActivityKind.THREAD, place, value, call)
        _follow(machine, state, function, name)
        machine.world.handed_on.append((state, name))
        if answers(name, whose):
            machine.world.answering.add(id(state))


def _handed(machine: RosInterpreter) -> Iterator[tuple[Value, Function, Place, str, str]]:
    seen = set[tuple[int, int]]()
    world = machine.world
    followed = _of_unknown_code(world)
    overriding = (
        (handler, handler.function.place, base, '')
        for instance in world.instances
        for handler, base in handlers_of(instance)
    )
    for value, place, name, whose in (*world.handed[:MOST_CALLBACKS], *overriding):
        inner = value
        while isinstance(inner, Partial):
            inner = inner.function
        function = inner.function if isinstance(inner, Bound) else inner
        receiver = inner.receiver if isinstance(inner, Bound) else None
        if not isinstance(function, Function) or (id(function.node), id(receiver)) in seen:
            continue
        seen.add((id(function.node), id(receiver)))
        is_followed = id(function.node) in followed
        is_new = id(function.node) not in world.called or name.endswith((BY_NAME, BY_CALLBACK))
        if is_followed or (is_new and not may_make_entities(world, function.node)):
            yield value, function, place, name, whose


def _of_unknown_code(world: RosWorld) -> frozenset[int]:
    """What was followed all the same, as unknown code may call it, and what that calls alone."""
    uncalled = world.without_caller.keys()
    return frozenset(world.escaped_to_unknown | world.called_later | uncalled)


_OTHERS = 'loop of code that is not scanned'


def _is_coroutine(function: Function) -> bool:
    return isinstance(function.node, ast.AsyncFunctionDef)


def _follow(machine: RosInterpreter, state: ActivityState, function: Function, name: str) -> None:
    """A coroutine of a web server is a task of its loop, which may run it for several clients."""
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

    many = not is_called_once(name)
    task = LoopTask(function.name, _OTHERS, many=many) if _is_coroutine(function) else None
    with as_root(world, id(state), task) if task is not None else nullcontext():
        guarded(machine, follow, state.place)
    world.only_data = False
    _put_back(kept)
    if task is not None:
        world.loop_roots[id(state)] = task


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
