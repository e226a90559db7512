"""
Loops that do nothing but wait until somebody else has changed plain data.

``while not self.arrived: time.sleep(0.1)`` waits as ``Event.wait`` does; who writes what the test
reads ends it.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import DataRef, ResourceRef
from ros2cc_extract.extract.static.concurrency.waits import message_loops, retry_loops
from ros2cc_extract.extract.static.concurrency.waits.cleared_events import sent_by_now, sent_up_to
from ros2cc_extract.extract.static.concurrency.waits.counted_tests import rise_of
from ros2cc_extract.extract.static.concurrency.waits.loop_tests import (
    asks_for_cancel,
    asks_for_service,
    asks_object,
    exit_tests,
    is_neutral,
    leaves,
    name_of,
    names_assigned,
    names_grown,
    only_sleeps,
    owners,
    runs_out,
)
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import note_loop
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import (
    awaits_each_round,
    call_of_loop,
    is_endless,
    is_idle,
    only_waits,
    spins,
)
from ros2cc_extract.extract.static.program.retried_calls import is_retried
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.dependences import Asked
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.path_facts import Facts, Told, told_by
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.objects.reachable_texts import reachable
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Function,
    Heaped,
    Mystery,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import (
    ANSWER_LOOP,
    ENDLESS_LOOP,
    POLLING_LOOP,
    TIME,
    WORKING_LOOP,
    Blocking,
)

POLL = POLLING_LOOP
_OF_ROUNDS = retry_loops.RAISE_WHEN_OVER | {POLL, WORKING_LOOP, ANSWER_LOOP, 'busy wait'}


@dataclass(frozen=True)
class Mark:
    """How much had been noted when a loop began."""

    waits: int
    writes: int
    own: int
    order: int


def mark(machine: ConcurrentMachine) -> Mark | None:
    """Before the loop; ``None`` where nothing is noted."""
    effects = machine.world.effects
    return (
        None
        if effects is None
        else Mark(len(effects.blocking), len(effects.writes), len(effects.own), len(effects.order))
    )


def begin(machine: ConcurrentMachine, loop: ast.While, frame: Frame, told: Told | None) -> None:
    """
    A ``while`` loop begins; one that only waits for a future is a busy wait.

    A coroutine that awaits in each round gives its thread back, as one that awaits the future.

    :param told: what its test tells.
    """
    world = machine.world
    if world.effects is None and not is_idle(loop) and not asks_for_service(loop.test):
        return
    place = frame.place(loop)
    retry_loops.begin(machine, loop, frame)
    _note_rest(machine, loop, frame)
    is_known = told is not None and _note_things(machine, loop, frame, told)
    if not is_known:
        is_known = _note_by_name(machine, loop, frame) or _note_answer(machine, loop, frame)
    if world.in_callback and not is_known and spins(loop):
        # How many callbacks run before it ends is not one.
        reason = f'what ends the loop: {ast.unparse(loop.test)}'
        machine.note_blocking('busy wait', machine.mystery(reason, place), None, place)


def _note_rest(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> None:
    """A loop of asyncio runs others in each round that awaits."""
    if machine.world.effects is not None and awaits_each_round(loop):
        machine.world.effects.resting.update(map(frame.place, (loop, *exit_tests(loop))))


def _note_by_name(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> bool:
    """Whether the test asks something by the name of such a method; what it asks is told."""
    is_known = False
    for part in ast.walk(loop.test):
        if (
            isinstance(part, ast.Call)
            and isinstance(part.func, ast.Attribute)
            and part.func.attr in _ASKED
        ):
            is_known, waited = True, _ASKED[part.func.attr]
            if part.func.attr in ('done', 'is_set'):
                owner = machine.evaluate(part.func.value, frame)
                _note_busy(machine, loop, owner, None, frame)
            elif waited and _is_retried(part, frame):
                owner = machine.evaluate(part.func.value, frame)
                machine.note_blocking(waited, owner, None, frame.place(part))
    return is_known


def _note_answer(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> bool:
    """Whether the test asks a library that asks others outside; the loop waits for these."""
    world = machine.world
    calls = (frame.place(part) for part in ast.walk(loop.test) if isinstance(part, ast.Call))
    is_asked = any(place in world.asked_outside for place in calls)
    if is_asked and world.effects is not None:
        machine.note_blocking(ANSWER_LOOP, None, None, frame.place(loop))
    return is_asked


def _is_retried(call: ast.Call, frame: Frame) -> bool:
    function = frame.function
    return function is not None and is_retried(function.node, frame.place(call))


_ASKED = {
    'done': '',
    'is_set': '',
    'wait_for_service': '',
    'wait_for_server': '',
    'service_is_ready': 'wait_for_service',
    'server_is_ready': 'wait_for_server',
}
"""What tests ask by name, and what waits as a loop does that asks so until the answer is yes."""


def _note_busy(
    machine: ConcurrentMachine, loop: ast.While, on: Value, seconds: Value | None, frame: Frame
) -> None:
    own = call_of_loop(loop, 'busy wait', machine.world.activity)
    call = 'await' if _gives_back(machine, loop) else own
    machine.note_blocking(call, on, seconds, frame.place(loop))


def _gives_back(machine: ConcurrentMachine, loop: ast.While) -> bool:
    """Whether a coroutine that an executor runs gives its thread back in each round."""
    frees = machine.world.in_callback and not machine.world.on_loop
    return frees and awaits_each_round(loop)


def _note_things(machine: ConcurrentMachine, loop: ast.While, frame: Frame, told: Told) -> bool:
    """Whether what happens to objects makes the test fail; the loop waits for that."""
    tests = list(exit_tests(loop))
    place = frame.place(loop)
    why = Unknown('the loop also ends otherwise', place)
    is_timed = any(_ends_otherwise(machine, test, loop, frame) for test in tests)
    seconds = Mystery(why) if is_timed else None
    needed, any_of_them = _things(told.fails), _things(told.breaks)
    if told.is_either and any_of_them:
        _note_busy(machine, loop, choice(any_of_them), seconds, frame)
    elif needed or len(any_of_them) == 1:
        for thing in needed or any_of_them:
            _note_busy(machine, loop, thing, seconds, frame)
    elif any_of_them:
        first = machine.mystery('it waits for the first of several', place)
        _note_busy(machine, loop, first, seconds, frame)
    return bool(any_of_them)


def _things(facts: Facts) -> list[Value]:
    """In the order in which they were made."""
    found = dict.fromkeys(thing for thing, _ in facts)
    return sorted(found, key=lambda thing: thing.serial if isinstance(thing, Heaped) else 0)


def _ends_otherwise(
    machine: ConcurrentMachine, test: ast.expr, loop: ast.While, frame: Frame
) -> bool:
    """Whether something may end the loop as well, beside what is asked of objects."""
    if isinstance(test, ast.BoolOp):
        return any(_ends_otherwise(machine, each, loop, frame) for each in test.values)
    if isinstance(test, ast.UnaryOp):
        return _ends_otherwise(machine, test.operand, loop, frame)
    if _tells(machine, test, frame):
        return False
    return runs_out(test, loop) or asks_for_cancel(test)


def _tells(machine: ConcurrentMachine, test: ast.expr, frame: Frame) -> bool:
    return asks_object(test) or _told_now(machine, test, frame) is not None


def _told_now(machine: ConcurrentMachine, test: ast.expr, frame: Frame) -> Told | None:
    """What a test tells where it stands, without any note of what it reads."""
    world = machine.world
    noted, ready, world.effects = world.effects, world.ready, EffectLog()
    try:
        return told_by(machine.evaluate(test, frame))
    finally:
        world.effects, world.ready = noted, ready


def _told_by_exits(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> Told | None:
    """What makes a loop end whose test tells of it only after a round, or stands inside."""
    for test in exit_tests(loop):
        told = _told_now(machine, test, frame)
        if told is not None:
            return told if test is loop.test else told.negated()
    return None


def note(machine: ConcurrentMachine, loop: ast.While, frame: Frame, before: Mark | None) -> None:
    """After one round of ``loop``."""
    effects = machine.world.effects
    if before is None or effects is None:
        is_told = message_loops.note(machine, loop, frame)
        if is_told or retry_loops.note_in_set_up(machine, loop, frame):
            return
        _note_set_up(machine, loop, frame)
        _note_spinning(machine, loop, frame)
        return
    _note_asked(machine, loop, effects, before, frame)
    _note_own_end(machine.world, loop, effects, before, frame)
    tests = list(exit_tests(loop))
    if not tests and retry_loops.note(machine, loop, frame, before.waits):
        return
    asked = machine.world.reading.asked.get(frame.place(loop))
    inside = effects.blocking[before.waits :]
    if _only_asks(machine, inside) and message_loops.note(machine, loop, frame):
        return
    if _is_told(machine, loop, effects, before) or any(_is_guarded(b, asked) for b in inside):
        return
    told = _told_by_exits(machine, loop, frame)
    if told is not None and _note_things(machine, loop, frame, told):
        return
    if not tests:
        if is_endless(loop) and machine.world.in_callback and not leaves(loop):
            place = frame.place(loop)
            unknown = Unknown('nothing but the end of the program ends the loop', place)
            machine.note_loop_on_data(ENDLESS_LOOP, unknown, None, place)
        return
    names = _read(machine, [test for test in tests if not asks_object(test)], frame)
    written = {access.name for access in effects.writes[before.writes :]}
    if names & (written | set(effects.own[before.own :])):
        return
    _note(machine, loop, frame, tests, names, sent_up_to(effects, before.order))


def mark_recursive(
    machine: ConcurrentMachine, loop: ast.While, frame: Frame, before: Mark
) -> None:
    """What the rounds of a loop wait for is waited for by calls inside calls."""
    effects = machine.world.effects or EffectLog()
    lines = range(loop.lineno, (loop.end_lineno or loop.lineno) + 1)
    file = frame.place(loop).file
    for number, block in enumerate(effects.blocking[before.waits :], before.waits):
        place = block.source
        is_here = place is not None and place.file == file and place.line in lines
        if is_here and block.seconds is None and block.call in _OF_ROUNDS:
            effects.blocking[number] = replace(block, recursive=True)


def _note_own_end(
    world: ConcurrentWorld, loop: ast.While, effects: EffectLog, before: Mark, frame: Frame
) -> None:
    """A thread that works until it has set itself what it tests waits for nobody."""
    place, lines = frame.place(loop), range(loop.lineno, (loop.end_lineno or loop.lineno) + 1)
    for number, block in enumerate(effects.blocking[before.waits :], before.waits):
        if block.call != WORKING_LOOP or not isinstance(block.resource, ResourceRef):
            continue
        wakings = world.wakings.get(block.resource.number, ())
        own_places = [waking.place for waking in wakings if waking.by is world.activity]
        if any(each.file == place.file and each.line in lines for each in own_places):
            own = Unknown('the loop sets itself what ends it', place)
            effects.blocking[number] = replace(block, seconds=block.seconds or own)


def _note_set_up(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> None:
    """Code that nobody serves looks at data again and again, and only sleeps meanwhile."""
    if asks_object(loop.test) and not leaves(loop):
        calls = (part for part in ast.walk(loop.test) if isinstance(part, ast.Call))
        machine.world.asked_until.update(frame.place(call) for call in calls)
    is_plain = is_idle(loop) and not asks_object(loop.test) and not leaves(loop)
    if not is_plain or is_endless(loop) or _is_foreign(machine, loop.test, loop, frame):
        return
    names = _read(machine, [loop.test], frame)
    if names and _holds(machine, loop.test, frame):
        note_loop(machine.world, names, frame.place(loop.test))


def _note_spinning(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> None:
    """Code that no callback runs only spins or sleeps until something has changed."""
    if is_endless(loop) or not (only_waits(loop) or spins(loop)):
        return
    world = machine.world
    end = getattr(loop, 'end_lineno', None) or loop.lineno
    place = frame.place(loop)
    spun = world.served_within(place.file, loop.lineno, end)
    told = _told_now(machine, loop.test, frame)
    things = _things(told.fails | told.breaks) if told is not None else []
    if things:
        is_timed = _ends_otherwise(machine, loop.test, loop, frame)
        why = Mystery(Unknown('the loop also ends otherwise', place)) if is_timed else None
        for thing in things if spun else ():
            machine.note_outside_wait('busy wait', thing, why, place, spun)
        return
    is_foreign = _is_foreign(machine, loop.test, loop, frame)
    names = _read(machine, [loop.test], frame)
    if names:
        is_foreign = is_foreign or not (only_waits(loop) or _leaves_to_others(world, loop, names))
        reason = Unknown('the loop also ends otherwise', place)
        reference = DataRef(sorted(names)[0])
        reference.names = frozenset(names)
        machine.note_loop_on_data(POLL, reference, reason if is_foreign else None, place, spun)


def _leaves_to_others(world: ConcurrentWorld, loop: ast.While, names: set[str]) -> bool:
    """Whether neither the loop nor what it calls by name stores what its test looks at."""
    attributes = {name.rpartition('.')[2] for name in names}
    stores = (
        isinstance(part, ast.Attribute)
        and isinstance(part.ctx, ast.Store)
        and part.attr in attributes
        for node in reachable(world, loop)
        for part in walk(node)
    )
    return not leaves(loop) and not any(stores)


def _holds(machine: ConcurrentMachine, test: ast.expr, frame: Frame) -> bool:
    """Whether it comes out so for certain, as long as nobody shuts rclpy down."""
    if isinstance(test, ast.BoolOp) and isinstance(test.op, ast.And):
        return all(_holds(machine, each, frame) for each in test.values)
    is_ok = isinstance(test, ast.Call) and name_of(test) == 'ok'
    return is_ok or machine.truth(machine.evaluate(test, frame)) is True


def _note_asked(
    machine: ConcurrentMachine,
    loop: ast.While,
    effects: EffectLog,
    before: Mark,
    frame: Frame,
) -> None:
    """A condition is waited on only where the test of the loop has come out so."""
    for number in range(before.waits, len(effects.blocking)):
        block = effects.blocking[number]
        if block.call == 'Condition.wait' and _read(machine, [loop.test], frame):
            effects.blocking[number] = replace(block, conditional=True)


def _note(
    machine: ConcurrentMachine,
    loop: ast.While,
    frame: Frame,
    tests: list[ast.expr],
    names: set[str],
    sent: frozenset[str],
) -> None:
    place = frame.place(tests[0])
    call = call_of_loop(loop, POLL, machine.world.activity)
    call = 'await' if _gives_back(machine, loop) else call
    ends_otherwise = any(_is_foreign(machine, test, loop, frame) for test in tests)
    if names:
        own = frozenset(
            (access.name, access.source)
            for access in (machine.world.effects or EffectLog()).writes
        )
        reference = DataRef(sorted(names)[0])
        reference.names, reference.before = frozenset(names), own
        reference.rise = rise_of(machine, tests, frame)
        reference.sent = sent
        reference.sent_by_now = sent_by_now(machine.world.effects or EffectLog())
        reason = Unknown('the loop also ends otherwise', place)
        machine.note_loop_on_data(call, reference, reason if ends_otherwise else None, place)
    elif (not ends_otherwise or only_sleeps(loop, tests)) and not any(
        asks_for_service(test) for test in tests
    ):
        text = ' or '.join(ast.unparse(test) for test in tests)
        unknown = Unknown(f'what ends the loop: {text}', place)
        machine.note_loop_on_data(call, unknown, None, place)


def _is_guarded(block: Blocking, asked: Asked | None) -> bool:
    """Whether the loop asks, under the lock of a condition, for what it waits on that for."""
    guard = block.resource.guard if isinstance(block.resource, ResourceRef) else None
    return guard is not None and asked is not None and guard.hold in asked.holds


def _is_told(
    machine: ConcurrentMachine, loop: ast.While, effects: EffectLog, before: Mark
) -> bool:
    """Whether the loop is told by what it waits for inside; a thread's loop ends by its test."""
    inside = effects.blocking[before.waits :]
    others = [block for block in inside if not _is_pause(machine, block.call)]
    if any(b.call in ('busy wait', ANSWER_LOOP) or b.suspends or 'spin' in b.call for b in others):
        return True
    return bool(others) and machine.world.activity is None


def _only_asks(machine: ConcurrentMachine, inside: Sequence[Blocking]) -> bool:
    """Whether its rounds wait for nothing but time, and for what it asks for itself."""
    return all(_is_pause(machine, b.call) or message_loops.is_asking(b.call) for b in inside)


def _is_pause(machine: ConcurrentMachine, call: str) -> bool:
    row = machine.model.waits.get(call)
    return call == 'Rate.sleep' or (row is not None and row.always == (TIME,))


def _read(machine: ConcurrentMachine, tests: list[ast.expr], frame: Frame) -> set[str]:
    """Names of the shared data that the tests read."""
    world = machine.world
    noted, world.effects = world.effects, EffectLog()
    try:
        for test in tests:
            machine.evaluate(test, frame)
        return {access.name for access in world.effects.reads}
    finally:
        world.effects = noted


def _is_foreign(machine: ConcurrentMachine, test: ast.expr, loop: ast.While, frame: Frame) -> bool:
    """Whether something else than shared data may turn out otherwise: a clock, a counter."""
    parts = [part for each in loop.body for part in walk(each)]
    assigned = {name for part in parts for name in names_assigned(part)}
    grown = {name for part in parts for name in names_grown(part)} - owners(test)
    for part in walk(test):
        if isinstance(part, ast.Name) and part.id in assigned | grown:
            return True
        if isinstance(part, (ast.Call, ast.Await, ast.NamedExpr)) and not (
            is_neutral(part) or _only_looks(machine, part, frame)
        ):
            return True
    return False


def _only_looks(machine: ConcurrentMachine, part: ast.expr, frame: Frame) -> bool:
    """A call of functions of the program that ask nothing else than what they read."""
    if not isinstance(part, ast.Call):
        return False
    world = machine.world
    noted, world.effects = world.effects, EffectLog()
    try:
        called = options_of(machine.evaluate(part.func, frame))
    finally:
        world.effects = noted
    functions = [each.function if isinstance(each, Bound) else each for each in called]
    return bool(functions) and all(map(_asks_nobody, functions))


def _asks_nobody(function: Value) -> bool:
    if not isinstance(function, Function) or function.is_coroutine:
        return False
    asking = (ast.Call, ast.Await, ast.NamedExpr, ast.Yield, ast.YieldFrom)
    parts = walk(function.node)
    return all(is_neutral(part) for part in parts if isinstance(part, asking))
