"""
Loops that do nothing but wait until somebody else has changed plain data.

``while not self.arrived: time.sleep(0.1)`` waits as ``Event.wait`` does; who writes what the test
reads ends it.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, replace

from ros2cc_extract.extract.static.doing import Deeds
from ros2cc_extract.extract.static.machine import Frame, Machine
from ros2cc_extract.extract.static.outside_waits import call_of_loop, is_endless, is_idle
from ros2cc_extract.extract.static.relevance import walk
from ros2cc_extract.extract.static.wait_table import WAITS
from ros2cc_extract.extract.static.wakings import DataRef
from ros2cc_extract.places import Unknown
from ros2cc_extract.spec.deeds import TIME

POLL = 'polling loop'
ENDLESS = 'endless loop'
_LEAVES = (ast.Break, ast.Return, ast.Raise)
_INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)
_NEUTRAL = frozenset(
    ['ok', 'len', 'bool', 'any', 'all', 'isinstance', 'hasattr', 'getattr', 'set']
)
_CLOCKS = frozenset(['time', 'monotonic', 'perf_counter', 'now', 'get_clock', 'time_ns'])
_ASKED = frozenset(['done', 'is_set', 'wait_for_service', 'service_is_ready', 'server_is_ready'])


@dataclass(frozen=True)
class Mark:
    """How much had been noted when a loop began."""

    waits: int
    writes: int
    own: int


def mark(machine: Machine) -> Mark | None:
    """Before the loop; ``None`` where nothing is noted."""
    deeds = machine.world.deeds
    return None if deeds is None else Mark(len(deeds.blocking), len(deeds.writes), len(deeds.own))


def note(machine: Machine, loop: ast.While, frame: Frame, before: Mark | None) -> None:
    """After one round of ``loop``."""
    deeds = machine.world.deeds
    if before is None or deeds is None:
        return
    _note_asked(machine, loop, deeds, before, frame)
    if _is_told(machine, loop, deeds, before):
        return
    tests = list(_exit_tests(loop))
    if not tests:
        if is_endless(loop) and machine.world.in_callback and not _leaves(loop):
            place = frame.place(loop)
            unknown = Unknown('nothing but the end of the program ends the loop', place)
            machine.note_loop_on_data(ENDLESS, unknown, None, place)
        return
    names = _read(machine, [test for test in tests if not _asks_object(test)], frame)
    written = {access.name for access in deeds.writes[before.writes :]}
    if names & (written | set(deeds.own[before.own :])):
        return
    _note(machine, loop, frame, tests, names)


def _note_asked(
    machine: Machine, loop: ast.While, deeds: Deeds, before: Mark, frame: Frame
) -> None:
    """A condition is waited on only where the test of the loop has come out so."""
    for number in range(before.waits, len(deeds.blocking)):
        block = deeds.blocking[number]
        if block.call == 'Condition.wait' and _read(machine, [loop.test], frame):
            deeds.blocking[number] = replace(block, conditional=True)


def _note(
    machine: Machine, loop: ast.While, frame: Frame, tests: list[ast.expr], names: set[str]
) -> None:
    place = frame.place(tests[0])
    call = call_of_loop(loop, POLL, machine.world.activity)
    ends_otherwise = any(_is_foreign(test, loop) for test in tests)
    if names:
        own = frozenset(
            (access.name, access.source) for access in (machine.world.deeds or Deeds()).writes
        )
        reference = DataRef(sorted(names)[0])
        reference.names, reference.before = frozenset(names), own
        reason = Unknown('the loop also ends otherwise', place)
        machine.note_loop_on_data(call, reference, reason if ends_otherwise else None, place)
    elif (not ends_otherwise or _is_idle(loop, tests)) and not any(
        _asks_object(test) for test in tests
    ):
        text = ' or '.join(ast.unparse(test) for test in tests)
        unknown = Unknown(f'what ends the loop: {text}', place)
        machine.note_loop_on_data(call, unknown, None, place)


def _is_idle(loop: ast.While, tests: list[ast.expr]) -> bool:
    """Whether it only sleeps until something is answered otherwise that no clock tells."""
    called = {
        _name_of(part) for test in tests for part in walk(test) if isinstance(part, ast.Call)
    }
    return is_idle(loop) and called.isdisjoint(_CLOCKS) and not _counts(loop)


def _counts(loop: ast.While) -> bool:
    return any(
        isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)
        for each in loop.body
        for part in walk(each)
    )


def _is_told(machine: Machine, loop: ast.While, deeds: Deeds, before: Mark) -> bool:
    """Whether the loop is told by what it waits for inside; a thread's loop ends by its test."""
    inside = deeds.blocking[before.waits :]
    others = [block for block in inside if not _is_pause(block.call)]
    if any(block.call in ('busy wait', 'await') or 'spin' in block.call for block in others):
        return True
    return bool(others) and machine.world.activity is None


def _is_pause(call: str) -> bool:
    row = WAITS.get(call)
    return call == 'Rate.sleep' or (row is not None and row.always == (TIME,))


def _exit_tests(loop: ast.While) -> Iterator[ast.expr]:
    """Tests one of which must come out otherwise for the loop to end."""
    if not is_endless(loop):
        yield loop.test
    for part in _own_parts(loop):
        if isinstance(part, ast.If) and any(
            isinstance(each, _LEAVES) for arm in (part.body, part.orelse) for each in arm
        ):
            yield part.test


def _leaves(loop: ast.While) -> bool:
    return any(isinstance(part, (*_LEAVES, ast.Yield, ast.Await)) for part in _own_parts(loop))


def _own_parts(loop: ast.While) -> Iterator[ast.AST]:
    """What stands in the body of a loop, and in no function inside of it."""
    waiting: list[ast.AST] = list(loop.body)
    while waiting:
        part = waiting.pop(0)
        if not isinstance(part, _INNER):
            yield part
            waiting.extend(ast.iter_child_nodes(part))


def _read(machine: Machine, tests: list[ast.expr], frame: Frame) -> set[str]:
    """Names of the shared data that the tests read."""
    world = machine.world
    noted, world.deeds = world.deeds, Deeds()
    try:
        for test in tests:
            machine.evaluate(test, frame)
        return {access.name for access in world.deeds.reads}
    finally:
        world.deeds = noted


def _is_foreign(test: ast.expr, loop: ast.While) -> bool:
    """Whether something else than shared data may turn out otherwise: a clock, a counter."""
    parts = [part for each in loop.body for part in walk(each)]
    assigned = {name for part in parts for name in _assigned(part)}
    grown = {name for part in parts for name in _grown(part)} - _owners(test)
    for part in walk(test):
        if isinstance(part, ast.Name) and part.id in assigned | grown:
            return True
        if isinstance(part, (ast.Call, ast.Await, ast.NamedExpr)) and not _is_neutral(part):
            return True
    return False


def _assigned(part: ast.AST) -> Iterator[str]:
    if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store):
        yield part.id


def _grown(part: ast.AST) -> Iterator[str]:
    """Names whose object a method, an assignment to an item, or who gets it may change."""
    if isinstance(part, ast.Call) and _name_of(part) not in _NEUTRAL:
        yield from (each.id for each in part.args if isinstance(each, ast.Name))
    target = part.func if isinstance(part, ast.Call) else part
    is_stored = isinstance(part, ast.Subscript) and isinstance(part.ctx, ast.Store)
    if (isinstance(part, ast.Call) or is_stored) and isinstance(
        target, (ast.Attribute, ast.Subscript)
    ):
        owner = target.value
        if isinstance(owner, ast.Name):
            yield owner.id


def _owners(test: ast.expr) -> set[str]:
    """Names of which the test reads an attribute: that is shared data, and asked as such."""
    parts = (part.value for part in walk(test) if isinstance(part, ast.Attribute))
    return {owner.id for owner in parts if isinstance(owner, ast.Name)}


def _is_neutral(part: ast.expr) -> bool:
    return isinstance(part, ast.Call) and _name_of(part) in _NEUTRAL


def _name_of(call: ast.Call) -> str:
    function = call.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, 'id', '')


def _asks_object(test: ast.expr) -> bool:
    """What is asked by a method is told where that is noted."""
    return any(
        isinstance(part, ast.Call)
        and isinstance(part.func, ast.Attribute)
        and part.func.attr in _ASKED
        for part in walk(test)
    )
