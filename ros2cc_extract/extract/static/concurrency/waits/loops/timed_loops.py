"""
How long a loop lasts whose test only looks at a clock or counts its rounds.

``end = time.time() + 2.0; while time.time() < end: time.sleep(0.1)`` sleeps two seconds in all,
and so does ``i = 0; while i < 20: time.sleep(0.1); i += 1``. Without a sleep it is busy meanwhile.
"""

from __future__ import annotations

import ast
from dataclasses import replace
from math import ceil

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import CLOCKS
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Const
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import BUSY_LOOP, OUTSIDE, PAUSES, POLLING_LOOP

_CLOCKS = CLOCKS - {'time_ns', 'get_clock'}
_NANO = 1e-9
_LEAST, _MOST = 1e-12, 1e12
"""Other numbers are not counted with."""
_MOST_ROUNDS = 1_000_000
_DURATION = 'Duration'
_UNITS = {'seconds': 1.0, 'nanoseconds': _NANO}
"""Of its arguments, in seconds."""
_GOES_ON = 'ok'
"""``rclpy.ok()`` beside the test of the time changes nothing while the program runs."""


@dataclass(frozen=True)
class Length:
    """
    Of a loop: the seconds or the rounds that it takes at most.

    :param is_most: other tests may end it sooner.
    """

    seconds: float | None = None
    rounds: int | None = None
    is_most: bool = False


def length_of(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> Length | None:
    """Before the first round; ``None`` where it is not known."""
    tests = _tests(loop.test)
    if machine.world.effects is None:
        return None
    known = (_length_by(machine, loop, test, frame) for test in tests)
    length = next((each for each in known if each is not None), None)
    return length if length is None or len(tests) == 1 else replace(length, is_most=True)


def _length_by(
    machine: ConcurrentMachine, loop: ast.While, test: ast.expr, frame: Frame
) -> Length | None:
    if not isinstance(test, ast.Compare) or len(test.ops) != 1:
        return None
    less, more = test.left, test.comparators[0]
    if isinstance(test.ops[0], (ast.Gt, ast.GtE)):
        less, more = more, less
    elif not isinstance(test.ops[0], (ast.Lt, ast.LtE)):
        return None
    noted, machine.world.effects = machine.world.effects, None
    try:
        with machine.world.reading.apart():
            seconds = _seconds(machine, less, more, frame)
            is_exact = isinstance(test.ops[0], (ast.Lt, ast.Gt))
            rounds = _rounds(machine, loop, less, more, frame) if seconds is None else None
    finally:
        machine.world.effects = noted
    if seconds is None and rounds is None:
        return None
    return Length(seconds, None if rounds is None else min(_MOST_ROUNDS, rounds + (not is_exact)))


def note(
    machine: ConcurrentMachine,
    loop: ast.While,
    frame: Frame,
    length: Length,
    first: int,
    first_met: int,
) -> None:
    """
    After one round: it sleeps in each of them, or is busy all the time.

    :param first: where the waits of the round begin that were not met before.
    :param first_met: where all of them begin, as they were met.
    """
    effects = machine.world.effects or EffectLog()
    inside, place = effects.blocking[first:], frame.place(loop)
    tests = {frame.place(part) for part in _whole(loop)}
    if any(block.source in tests for block in inside):
        if length.is_most:
            return
        for number, block in enumerate(inside, first):
            ends_otherwise = isinstance(block.seconds, Unknown) and length.seconds is not None
            if block.call == POLLING_LOOP and block.source in tests and ends_otherwise:
                effects.blocking[number] = replace(block, seconds=length.seconds)
        return  # it waits for data as a whole
    pauses = _pauses(machine, effects, first_met)
    slept = sum(
        block.seconds * often
        for block, often in ((effects.blocking[number], often) for number, often in pauses)
        if isinstance(block.seconds, (int, float))
    )
    rounds = length.rounds
    if length.seconds is not None and slept > 0:
        rounds = ceil(min(_MOST_ROUNDS, length.seconds / slept))
    if rounds is not None and slept > 0:
        effects.met[first_met:] = [(number, often * max(1, rounds)) for number, often in pauses]
        for number, often in pauses:
            block = effects.blocking[number]
            times = block.times + often * (max(1, rounds) - 1)
            or_more = machine.world.open_loops > 0
            is_sleep = block.call in PAUSES
            is_skipped = block.conditional or (length.is_most and rounds > 1 and is_sleep)
            effects.blocking[number] = replace(
                block, times=times, or_more=or_more, conditional=is_skipped
            )
    elif length.is_most:
        return
    elif length.seconds is not None and not inside and len(effects.met) == first_met:
        machine.note_blocking(BUSY_LOOP, None, Const(length.seconds), place)


def _pauses(
    machine: ConcurrentMachine, effects: EffectLog, first_met: int
) -> list[tuple[int, int]]:
    """
    The sleeps of a round, by their number, and how often it sleeps there.

    So do waits for a device or another program, where nothing comes in their time.
    """
    often: dict[int, int] = {}
    for number, times in effects.met[first_met:]:
        block = effects.blocking[number] if number < len(effects.blocking) else None
        if block is None or block.suspends:
            continue
        row = machine.model.waits.get(block.call)
        is_of_others = row is not None and row.always == (OUTSIDE,)
        if block.call in PAUSES or (is_of_others and isinstance(block.seconds, (int, float))):
            often[number] = often.get(number, 0) + times
    return list(often.items())


def _whole(loop: ast.While) -> tuple[ast.AST, ...]:
    return loop, *(part for part in walk(loop.test) if isinstance(part, ast.expr))


def _tests(test: ast.expr) -> list[ast.expr]:
    """What all must hold for another round."""
    is_all = isinstance(test, ast.BoolOp) and isinstance(test.op, ast.And)
    parts = test.values if is_all and isinstance(test, ast.BoolOp) else [test]
    return [part for part in parts if not _asks_whether_it_goes_on(part)]


def _asks_whether_it_goes_on(test: ast.expr) -> bool:
    return isinstance(test, ast.Call) and not test.args and _called(test) == _GOES_ON


def _called(call: ast.Call) -> str | None:
    function = call.func
    if isinstance(function, ast.Attribute):
        return function.attr
    return function.id if isinstance(function, ast.Name) else None


def _seconds(
    machine: ConcurrentMachine, less: ast.expr, more: ast.expr, frame: Frame
) -> float | None:
    """``clock() < end``, or ``clock() - begun < seconds``."""
    if _is_clock(less):
        given = _stored(more, frame)
        added = given if isinstance(given, ast.BinOp) and isinstance(given.op, ast.Add) else None
        sides = () if added is None else (added.left, added.right)
        later = [side for side in sides if not _is_clock(side)]
        return _number(machine, later[0], frame) if len(later) == 1 else None
    passed, unit = _passed(less)
    if not isinstance(passed, ast.BinOp) or not isinstance(passed.op, ast.Sub):
        return None
    if not _is_clock(passed.left) or not _is_clock(_stored(passed.right, frame)):
        return None
    limit = _number(machine, more, frame)
    return None if limit is None else limit * unit


def _passed(node: ast.expr) -> tuple[ast.expr, float]:
    """``(clock() - begun).nanoseconds / 1e9``: the difference, and the seconds of its unit."""
    unit = 1.0
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Div, ast.Mult)):
        factor = _usual(node.right.value) if isinstance(node.right, ast.Constant) else None
        if factor is None or factor < _LEAST:
            return node, unit
        unit, node = factor if isinstance(node.op, ast.Div) else 1 / factor, node.left
    if isinstance(node, ast.Attribute) and node.attr == 'nanoseconds':
        unit, node = unit * _NANO, node.value
    return node, unit


def _rounds(
    machine: ConcurrentMachine,
    loop: ast.While,
    less: ast.expr,
    more: ast.expr,
    frame: Frame,
) -> int | None:
    """``i < n`` where each round adds to ``i``, or takes from ``n``."""
    begin, end = _number(machine, less, frame), _number(machine, more, frame)
    steps = [_step(loop, side, sign) for side, sign in ((less, ast.Add), (more, ast.Sub))]
    known = [step for step in steps if step is not None]
    if begin is None or end is None or len(known) != 1:
        return None
    return ceil((end - begin) / known[0])


def _step(loop: ast.While, counter: ast.expr, sign: type[ast.operator]) -> float | None:
    """What each round adds, if nothing else stores the counter."""
    if not isinstance(counter, ast.Name):
        return None
    stores = [
        part
        for part in walk(loop)
        if isinstance(part, ast.Name) and part.id == counter.id and isinstance(part.ctx, ast.Store)
    ]
    for each in loop.body:
        is_step = isinstance(each, ast.AugAssign) and isinstance(each.op, sign)
        if is_step and isinstance(each, ast.AugAssign) and stores == [each.target]:
            step = _usual(each.value.value) if isinstance(each.value, ast.Constant) else None
            return step if step is not None and step >= _LEAST else None
    return None


def _is_clock(node: ast.expr | None) -> bool:
    return isinstance(node, ast.Call) and _called(node) in _CLOCKS


def _stored(node: ast.expr, frame: Frame) -> ast.expr | None:
    """What a name of the function holds, if it is stored once."""
    if not isinstance(node, ast.Name) or frame.function is None:
        return node
    stored = [
        part.value
        for part in walk(frame.function.node)
        if isinstance(part, ast.Assign)
        and any(isinstance(to, ast.Name) and to.id == node.id for to in part.targets)
    ]
    return stored[0] if len(stored) == 1 else None


def _number(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> float | None:
    if isinstance(node, ast.Call) and _called(node) == _DURATION and not node.args:
        return _span(machine, node, frame)
    held = machine.evaluate(node, frame)
    return _usual(held.value) if isinstance(held, Const) else None


def _usual(value: object) -> float | None:
    """A number of a size with which one can count; ``1e400`` is infinite."""
    is_number = isinstance(value, (int, float)) and abs(value) <= _MOST
    return float(value) if is_number and isinstance(value, (int, float)) else None


def _span(machine: ConcurrentMachine, call: ast.Call, frame: Frame) -> float | None:
    """Seconds of ``Duration(seconds=1, nanoseconds=500)``."""
    whole = 0.0
    for given in call.keywords:
        value, unit = _number(machine, given.value, frame), _UNITS.get(given.arg or '')
        if value is None or unit is None:
            return None
        whole += value * unit
    return whole
