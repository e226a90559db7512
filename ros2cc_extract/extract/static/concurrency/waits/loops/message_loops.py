"""
Loops that go on until messages have brought what they ask for: simulated time, a transform.

``while (self.get_clock().now() - start).nanoseconds < 2e9: time.sleep(0.1)`` takes two seconds;
where ``use_sim_time`` is set, the time stands still until the node takes a message of ``/clock``,
and the loop waits as ``Clock.sleep_for`` does. ``while not buffer.can_transform(…)`` waits for the
subscriptions of the listener. Measured on rclpy 7.1.6; source of the transforms: geometry2 0.39.1,
``tf2_ros/transform_listener.py`` (only ``spin_thread`` serves them in a thread of their own) and
``buffer.py`` (a time-out is waited for in ``time.sleep``).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import DataRef
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import (
    LEAVES,
    exit_tests,
    is_neutral,
    name_of,
    own_parts,
)
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import (
    PASTIMES,
    ROS_CLOCKS,
    awaits_each_round,
    call_of_loop,
    spins,
)
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer, EffectLog
from ros2cc_extract.extract.static.python.values.values import Bound, Function, options_of
from ros2cc_extract.spec.effects import POLLING_LOOP

_TIME = '/clock'
_TRANSFORMS = frozenset(
    ['can_transform', 'can_transform_full', 'lookup_transform', 'lookup_transform_full']
)
_BRINGING = ROS_CLOCKS | _TRANSFORMS
_OF_VALUES = frozenset(
    ['Duration', 'Time', 'to_msg', 'from_msg', 'seconds_nanoseconds', 'float', 'int', 'str', 'abs']
)
_PLAIN = _OF_VALUES | PASTIMES
"""Calls that say no more than their arguments."""
_DEEPEST = 3


def is_asking(call: str) -> bool:
    """Whether a wait of that name asks whether messages have brought something."""
    return call.rpartition('.')[2] in _TRANSFORMS


def note(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> bool:
    """Tell of a loop that ends by what messages bring, or by data beside it; whether it is one."""
    tests = list(exit_tests(loop))
    if not tests or not _ends_by(loop, tests):
        return False
    return _note(machine, loop, _asked(loop, tests), frame)


def note_attempt(
    machine: ConcurrentMachine, loop: ast.While, tried: Sequence[ast.expr], frame: Frame
) -> bool:
    """The same of a loop that is left when it has computed ``tried`` without an error."""
    return _note(machine, loop, tried, frame)


def _note(
    machine: ConcurrentMachine, loop: ast.While, asked: Sequence[ast.expr], frame: Frame
) -> bool:
    if spins(loop) or awaits_each_round(loop):
        return False
    called = [_called(machine, each, frame, _DEEPEST) for each in asked]
    names = {name for each in called for name in each}
    if not names & _BRINGING or not names <= _BRINGING | _PLAIN:
        return False
    found, data = _read(machine, asked, frame)
    # A clock that goes on by itself ends a loop that asks for a transform as well.
    is_time = bool(names & ROS_CLOCKS)
    brings = [each for each in found if (each.topic == _TIME) == is_time]
    if len(brings) != 1 or _stores(loop, data) or (is_time and names & _TRANSFORMS):
        return False
    reference = DataRef(brings[0].topic)
    reference.names = frozenset(data)
    writes = (machine.world.effects or EffectLog()).writes
    reference.before = frozenset((access.name, access.source) for access in writes)
    call = call_of_loop(loop, POLLING_LOOP, machine.world.activity)
    machine.note_messages(call, brings[0], frame.place(asked[0]), reference)
    return True


def _ends_by(loop: ast.While, tests: Sequence[ast.expr]) -> bool:
    """Whether nothing but ``tests`` leads out of the loop."""
    inside = [part for part in own_parts(loop.body) if isinstance(part, LEAVES)]
    ifs = [part for part in own_parts(loop.body) if isinstance(part, ast.If)]
    arms = [arm for each in ifs if each.test in tests for arm in (each.body, each.orelse)]
    return all(any(part in arm for arm in arms) for part in inside)


def _asked(loop: ast.While, tests: Sequence[ast.expr]) -> list[ast.expr]:
    """What the tests look at, with what each round stores for them; empty where that is open."""
    names = {part.id for test in tests for part in walk(test) if isinstance(part, ast.Name)}
    parts = list(own_parts(loop.body))
    stores = [
        part
        for part in parts
        if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store) and part.id in names
    ]
    values = [
        part.value
        for part in parts
        if isinstance(part, ast.Assign) and any(store in part.targets for store in stores)
    ]
    return [*tests, *values] if len(values) == len(stores) else []


def _called(machine: ConcurrentMachine, asked: ast.AST, frame: Frame, depth: int) -> Iterator[str]:
    """Names of what it calls; functions of the program are replaced by what they call."""
    for part in _asking_parts(asked):
        if isinstance(part, ast.Call) and not is_neutral(part):
            name = name_of(part)
            inner = [] if name in _BRINGING | _PLAIN else _functions(machine, part, frame)
            if not inner or not depth:
                yield name
            for each in inner if depth else ():
                body = each.node.body
                for statement in body if isinstance(body, list) else [body]:
                    yield from _called(machine, statement, frame, depth - 1)
        elif isinstance(part, (ast.Await, ast.NamedExpr, ast.Yield, ast.YieldFrom)):
            yield type(part).__name__


def _asking_parts(asked: ast.AST) -> Iterator[ast.AST]:
    """Its parts, but for what a buffer is asked with."""
    waiting = [asked]
    while waiting:
        part = waiting.pop()
        yield part
        if isinstance(part, ast.Call) and name_of(part) in _TRANSFORMS:
            waiting.append(part.func)
        else:
            waiting.extend(ast.iter_child_nodes(part))


def _functions(machine: ConcurrentMachine, call: ast.Call, frame: Frame) -> list[Function]:
    """The functions of the program that are called, where all are such."""
    world = machine.world
    noted, world.effects = world.effects, EffectLog()
    try:
        called = options_of(machine.evaluate(call.func, frame))
    finally:
        world.effects = noted
    functions = [each.function if isinstance(each, Bound) else each for each in called]
    known = [each for each in functions if isinstance(each, Function) and not each.is_coroutine]
    return known if len(known) == len(functions) else []


def _read(
    machine: ConcurrentMachine, asked: Sequence[ast.expr], frame: Frame
) -> tuple[list[Doer], set[str]]:
    """The subscriptions that bring what is asked for, and the names of the data that is read."""
    world = machine.world
    noted, world.effects = world.effects, EffectLog()
    known, world.asked_messages = world.asked_messages, []
    try:
        for each in asked:
            machine.evaluate(each, frame)
        return world.asked_messages, {access.name for access in world.effects.reads}
    finally:
        world.effects, world.asked_messages = noted, known


def _stores(loop: ast.While, names: set[str]) -> bool:
    """Whether a round itself may store data of ``names``."""
    attributes = {name.rpartition('.')[2] for name in names}
    return any(
        isinstance(part, ast.Attribute)
        and isinstance(part.ctx, ast.Store)
        and part.attr in attributes
        for part in own_parts(loop.body)
    )
