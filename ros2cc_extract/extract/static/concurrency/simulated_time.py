"""
Loops that go on until the simulated time of a node has moved.

``while (self.get_clock().now() - start).nanoseconds < 2e9: time.sleep(0.1)`` takes two seconds;
where ``use_sim_time`` is set, the time stands still until the node takes a message of ``/clock``,
and the loop waits as ``Clock.sleep_for`` does. Measured on rclpy 7.1.6.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import DataRef
from ros2cc_extract.extract.static.concurrency.waits.loop_tests import (
    LEAVES,
    exit_tests,
    is_neutral,
    name_of,
    own_parts,
)
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import (
    awaits_each_round,
    call_of_loop,
    spins,
)
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer, EffectLog
from ros2cc_extract.extract.static.python.values.values import Bound, Function, Value, options_of
from ros2cc_extract.spec.effects import POLLING_LOOP

_OF_TIME = frozenset(
    ['now', 'get_clock', 'Duration', 'Time', 'to_msg', 'from_msg', 'seconds_nanoseconds', 'float']
)
"""Calls that say no more than their arguments and the time of a clock."""
_DEEPEST = 3


def note(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> bool:
    """Tell of a loop that ends by simulated time, or by data beside it; whether it is one."""
    tests = list(exit_tests(loop))
    if not tests or spins(loop) or awaits_each_round(loop) or not _ends_by(loop, tests):
        return False
    asked = _asked(loop, tests)
    if not asked or not all(_says_time(machine, each, frame, _DEEPEST) for each in asked):
        return False
    clocks, names = _read(machine, asked, frame)
    if len(clocks) != 1 or _stores(loop, names):
        return False
    reference = DataRef('/clock')
    reference.names = frozenset(names)
    writes = (machine.world.effects or EffectLog()).writes
    reference.before = frozenset((access.name, access.source) for access in writes)
    call = call_of_loop(loop, POLLING_LOOP, machine.world.activity)
    machine.note_clock(call, clocks[0], frame.place(tests[0]), reference)
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


def _says_time(machine: ConcurrentMachine, asked: ast.AST, frame: Frame, depth: int) -> bool:
    """Whether it calls nothing that may come out otherwise but a clock."""
    return all(
        isinstance(part, ast.Call)
        and (
            is_neutral(part)
            or name_of(part) in _OF_TIME
            or _is_helper(machine, part, frame, depth)
        )
        for part in walk(asked)
        if isinstance(part, (ast.Call, ast.Await, ast.NamedExpr, ast.Yield, ast.YieldFrom))
    )


def _is_helper(machine: ConcurrentMachine, call: ast.Call, frame: Frame, depth: int) -> bool:
    """Whether it calls functions of the program that ask nothing but a clock."""
    world = machine.world
    noted, world.effects = world.effects, EffectLog()
    try:
        called = options_of(machine.evaluate(call.func, frame))
    finally:
        world.effects = noted
    functions = [each.function if isinstance(each, Bound) else each for each in called]
    return bool(functions) and all(_asks_time(machine, each, frame, depth) for each in functions)


def _asks_time(machine: ConcurrentMachine, function: Value, frame: Frame, depth: int) -> bool:
    if not isinstance(function, Function) or function.is_coroutine or not depth:
        return False
    return all(_says_time(machine, each, frame, depth - 1) for each in function.node.body)


def _read(
    machine: ConcurrentMachine, asked: Sequence[ast.expr], frame: Frame
) -> tuple[list[Doer], set[str]]:
    """Those that move the clocks which are asked, and the names of the data that is read."""
    world = machine.world
    noted, world.effects = world.effects, EffectLog()
    known, world.asked_clocks = world.asked_clocks, []
    try:
        for each in asked:
            machine.evaluate(each, frame)
        clocks = {id(clock): clock for clock in world.asked_clocks}
        return list(clocks.values()), {access.name for access in world.effects.reads}
    finally:
        world.effects, world.asked_clocks = noted, known


def _stores(loop: ast.While, names: set[str]) -> bool:
    """Whether a round itself may store data of ``names``."""
    attributes = {name.rpartition('.')[2] for name in names}
    return any(
        isinstance(part, ast.Attribute)
        and isinstance(part.ctx, ast.Store)
        and part.attr in attributes
        for part in own_parts(loop.body)
    )
