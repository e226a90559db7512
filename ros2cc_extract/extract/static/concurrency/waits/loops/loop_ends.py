"""How a waiting loop ends: by data of the program, by itself, or in an unknown way."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Sequence
from enum import Enum, auto

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.waits.loops.local_copies import (
    copies_in,
    without_copies,
)
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import (
    exit_tests,
    is_neutral,
    lines_that_leave,
    name_of,
    names_assigned,
    names_grown,
    own_parts,
    owners,
    tells_time,
)
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    written_behind_constructors,
)
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import is_pastime
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, Looked
from ros2cc_extract.extract.static.python.objects.reachable_texts import reachable
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Const,
    Function,
    Instance,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import OUTSIDE, Access

_OF_TEXTS = frozenset(['strip', 'lower', 'upper', 'startswith', 'endswith', 'split'])
_OF_COLLECTIONS = frozenset(
    ['get', 'values', 'items', 'keys', 'count', 'index', 'copy', 'isdisjoint', 'issubset']
)
_GROWING = frozenset(
    ['append', 'appendleft', 'extend', 'insert', 'add', 'pop', 'popleft', 'popitem']
)
_OF_OWNERS = (ast.Attribute, ast.Subscript)
_ASKING = (ast.Call, ast.Await, ast.NamedExpr, ast.Yield, ast.YieldFrom)


class End(Enum):
    """What makes a test come out otherwise."""

    DATA = auto()
    """A write to what it reads, and nothing else."""
    ITSELF = auto()
    """Time passes, or a round of the loop changes it."""
    UNKNOWN = auto()
    """It asks code that is not followed."""


@dataclass(frozen=True)
class Seen:
    """
    What tests look at.

    :param names: of shared data.
    :param holders: the objects and attributes where that is.
    :param outside: why part of that may change without a write in the program.
    """

    names: frozenset[str]
    holders: frozenset[tuple[Instance, str]]
    outside: Unknown | None


def seen_by(machine: ConcurrentMachine, tests: Iterable[ast.expr], frame: Frame) -> Seen:
    """What the tests of a loop look at when they are asked now; nothing is noted."""
    world = machine.world
    noted, world.effects = world.effects, EffectLog(looked=Looked())
    try:
        for test in tests:
            machine.evaluate(test, frame)
        looked = world.effects.looked
        assert looked is not None
        names = frozenset(access.name for access in world.effects.reads)
        return Seen(names, frozenset(looked.holders), next(iter(looked.outside), None))
    finally:
        world.effects = noted


def written_by_rounds(
    effects: EffectLog, first: int, loop: ast.While, frame: Frame
) -> frozenset[str]:
    """
    The data that a round writes behind which there may be another one.

    :param first: where the writes of the round begin.
    """
    file, left = frame.place(loop).file, lines_that_leave(loop)

    def leaves(access: Access) -> bool:
        ways = (place for place in (access.source, *access.chain) if place is not None)
        return any(place.file == file and place.line in left for place in ways)

    return frozenset(access.name for access in effects.writes[first:] if not leaves(access))


def exits_of(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> list[ast.expr]:
    """The tests that may end a loop: not ``if timeout is not None and …`` without a time-out."""
    return [test for test in exit_tests(loop) if not _never_holds(machine, test, loop, frame)]


def _never_holds(
    machine: ConcurrentMachine, test: ast.expr, loop: ast.While, frame: Frame
) -> bool:
    """Whether a test inside comes out false in every round."""
    if test is loop.test:
        return False
    changed = _changed_in(loop, set())

    def is_surely(part: ast.expr, *, truth: bool) -> bool:
        if isinstance(part, ast.UnaryOp) and isinstance(part.op, ast.Not):
            return is_surely(part.operand, truth=not truth)
        if isinstance(part, ast.BoolOp):
            decides = any if isinstance(part.op, ast.Or) is truth else all
            return decides(is_surely(each, truth=truth) for each in part.values)
        names = {each.id for each in walk(part) if isinstance(each, ast.Name)}
        if not names.isdisjoint(changed) or seen_by(machine, [part], frame).names:
            return False
        options = evaluated(machine, part, frame)
        return bool(options) and all(machine.truth(each) is truth for each in options)

    return is_surely(test, truth=False)


def tests_of_data(
    machine: ConcurrentMachine, tests: Iterable[ast.expr], loop: ast.While, frame: Frame
) -> list[ast.expr]:
    """The tests of a loop, with the data itself for local copies that each round takes of it."""
    copies = copies_in(loop)
    return [without_copies(test, copies, lambda v: _looks(machine, v, frame)) for test in tests]


def end_of(
    machine: ConcurrentMachine, tests: Sequence[ast.expr], loop: ast.While, frame: Frame
) -> End:
    """What ends a loop that one of ``tests`` ends; what ends it by itself counts first."""
    ends = [_end_of(machine, test, loop, frame) for test in tests]
    if End.ITSELF in ends:
        return End.ITSELF
    return End.UNKNOWN if End.UNKNOWN in ends else End.DATA


def _end_of(machine: ConcurrentMachine, test: ast.expr, loop: ast.While, frame: Frame) -> End:
    if _is_grown(test, loop):
        return End.ITSELF
    asked: list[ast.expr] = [part for part in walk(test) if isinstance(part, _ASKING)]
    asked = [part for part in asked if not (is_neutral(part) or _only_looks(machine, part, frame))]
    changed = _changed_in(loop, owners(test))
    stored = [part.id for part in walk(test) if isinstance(part, ast.Name) and part.id in changed]
    answers = [_answer(name, loop) for name in stored]
    if any(answer is None for answer in answers):
        return End.ITSELF
    asked += [answer for answer in answers if answer is not None]
    if any(_tells_time(machine, part, frame) for part in asked):
        return End.ITSELF
    return End.UNKNOWN if asked else End.DATA


def _is_grown(test: ast.expr, loop: ast.While) -> bool:
    """
    Whether each round puts something into what the test reads, or takes it out.

    ``while len(grid.rows) < 3: grid.rows.append(0)`` waits for nobody.
    """
    calls = (each.value for each in loop.body if isinstance(each, ast.Expr))
    grown = {
        ast.unparse(call.func.value)
        for call in calls
        if isinstance(call, ast.Call)
        and isinstance(call.func, ast.Attribute)
        and call.func.attr in _GROWING
    }
    read = (part for part in walk(test) if isinstance(part, (ast.Attribute, ast.Name)))
    return bool(grown) and any(ast.unparse(part) in grown for part in read)


def _changed_in(loop: ast.While, shared: set[str]) -> set[str]:
    """Names that a round stores to, or of which it may change the object, unless it is shared."""
    parts = [part for each in loop.body for part in walk(each)]
    assigned = {name for part in parts for name in names_assigned(part)}
    return assigned | ({name for part in parts for name in names_grown(part)} - shared)


def _answer(name: str, loop: ast.While) -> ast.expr | None:
    """The call whose result each round stores under ``name``, if it stores nothing else there."""
    value = copies_in(loop).get(name)
    is_asked = any(isinstance(part, ast.Call) for part in walk(value)) if value else False
    return value if is_asked else None


def _tells_time(machine: ConcurrentMachine, part: ast.expr, frame: Frame) -> bool:
    """Whether it asks a clock, perhaps in a function of the program."""
    called = [each.func for each in walk(part) if isinstance(each, ast.Call)]
    if tells_time(part):
        return True
    functions = [each for function in called for each in _functions(machine, function, frame)]
    return any(
        tells_time(text) for each in functions for text in reachable(machine.world, each.node)
    )


def _functions(machine: ConcurrentMachine, called: ast.expr, frame: Frame) -> list[Function]:
    functions = (
        each.function if isinstance(each, Bound) else each
        for each in evaluated(machine, called, frame)
    )
    return [each for each in functions if isinstance(each, Function)]


def evaluated(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> tuple[Value, ...]:
    """What an expression may give where it stands; nothing is noted."""
    world = machine.world
    noted, world.effects = world.effects, EffectLog()
    try:
        return options_of(machine.evaluate(node, frame))
    finally:
        world.effects = noted


def asks_outside(
    machine: ConcurrentMachine, tests: Iterable[ast.expr], frame: Frame, seen: Seen
) -> bool:
    """
    Whether a test calls code of the program that asks a device or another program.

    Data may decide as well where some text writes it later than in a constructor.
    """
    if any(written_behind_constructors(machine.world, name) for name in seen.names):
        return False
    parts = (part for test in tests for part in walk(test))
    calls = {frame.place(part) for part in parts if isinstance(part, ast.Call)}
    effects = machine.world.effects or EffectLog()
    asked = (b for b in effects.blocking if not calls.isdisjoint(b.chain))
    rows = (machine.model.waits.get(block.call) for block in asked)
    return any(row is not None and row.always == (OUTSIDE,) for row in rows)


def asked_of_none(
    machine: ConcurrentMachine, tests: Iterable[ast.expr], frame: Frame
) -> ast.expr | None:
    """What is ``None`` for all that is known while a test asks it for more: that raises."""
    asked = (part.value for test in tests for part in walk(test) if isinstance(part, _OF_OWNERS))
    return next((each for each in asked if evaluated(machine, each, frame) == (NONE,)), None)


def _looks(machine: ConcurrentMachine, value: ast.expr, frame: Frame) -> bool:
    """Whether an expression may be computed once more, as nothing changes by it."""
    asked = (part for part in walk(value) if isinstance(part, _ASKING))
    return all(is_neutral(part) or _only_looks(machine, part, frame) for part in asked)


def _only_looks(machine: ConcurrentMachine, part: ast.expr, frame: Frame) -> bool:
    """A call that asks nothing else than data of the program."""
    if not isinstance(part, ast.Call):
        return False
    if isinstance(part.func, ast.Attribute) and name_of(part) in _OF_TEXTS:
        return True
    if isinstance(part.func, ast.Attribute) and name_of(part) in _OF_COLLECTIONS:
        return all(map(_is_data, evaluated(machine, part.func.value, frame)))
    called = evaluated(machine, part.func, frame)
    functions = [each.function if isinstance(each, Bound) else each for each in called]
    return bool(functions) and all(map(_asks_nobody, functions))


def _is_data(value: Value) -> bool:
    return isinstance(value, (Collection, Const))


def _asks_nobody(function: Value) -> bool:
    if not isinstance(function, Function) or function.is_coroutine:
        return False
    return all(is_neutral(part) for part in walk(function.node) if isinstance(part, _ASKING))


def only_passes_time(loop: ast.While, tests: Iterable[ast.expr]) -> bool:
    """
    Whether a loop does nothing but ask its tests and let time pass.

    :param tests: those that end it, as they stand in the source.
    """
    asked = {id(part) for test in tests for part in walk(test)}
    asked |= {id(part) for value in copies_in(loop).values() for part in walk(value)}
    calls = [part for part in own_parts(loop.body) if isinstance(part, (ast.Call, ast.Await))]
    others = [part for part in calls if id(part) not in asked]
    return all(map(is_pastime, others)) and (bool(others) or not copies_in(loop))
