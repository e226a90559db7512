"""
Loops that do nothing but wait until somebody else has changed plain data.

``while not self.arrived: time.sleep(0.1)`` waits as ``Event.wait`` does; what writes what the test
reads ends it.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.loop_formulas import LoopTest
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import DataRef, ResourceRef
from ros2cc_extract.extract.static.concurrency.waits.cleared_events import sent_by_now, sent_up_to
from ros2cc_extract.extract.static.concurrency.waits.loops import (
    endless_loops,
    item_loops,
    message_loops,
    retry_loops,
    timed_loops,
)
from ros2cc_extract.extract.static.concurrency.waits.loops.counted_tests import rise_of
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_ends import (
    End,
    Seen,
    asked_of_none,
    asks_outside,
    end_of,
    exits_of,
    only_passes_time,
    seen_by,
    tests_of_data,
    written_by_rounds,
)
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import (
    asks_for_cancel,
    asks_for_service,
    asks_object,
    exit_tests,
    leaving_branches,
    only_sleeps,
    runs_out,
)
from ros2cc_extract.extract.static.concurrency.waits.loops.values_that_stay import (
    needed_of,
    tests_of,
)
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import (
    awaits_each_round,
    call_of_loop,
    is_idle,
    minds_nothing,
    spins,
)
from ros2cc_extract.extract.static.program.generator_texts import yields_each_round
from ros2cc_extract.extract.static.program.retried_calls import is_retried
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.dependences import Asked
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.path_facts import (
    Facts,
    Implied,
    Word,
    implied_by,
)
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.extract.static.python.values.values import (
    Heaped,
    Mystery,
    Value,
    choice,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import (
    ANSWER_LOOP,
    POLLING_LOOP,
    TIME,
    WORKING_LOOP,
    Blocking,
)

POLL = POLLING_LOOP
_FIRST_OF = 'it waits for the first of several'
_OF_ROUNDS = retry_loops.RAISE_WHEN_OVER | {POLL, WORKING_LOOP, ANSWER_LOOP, 'busy wait'}


@dataclass(frozen=True)
class Mark:
    """
    How much had been noted when a loop began.

    :param length: how long it lasts, where only the time decides.
    """

    waits: int
    writes: int
    own: int
    order: int
    met: int
    length: timed_loops.Length | None = None


def mark(machine: ConcurrentMachine, length: timed_loops.Length | None = None) -> Mark | None:
    """Before the loop; ``None`` where nothing is noted."""
    effects = machine.world.effects
    if effects is None:
        return None
    waits, writes, own = len(effects.blocking), len(effects.writes), len(effects.own)
    return Mark(waits, writes, own, len(effects.order), len(effects.met), length)


def begin(
    machine: ConcurrentMachine, loop: ast.While, frame: Frame, implied: Implied | None
) -> None:
    """
    A ``while`` loop begins; one that only waits for a future is a busy wait.

    A coroutine that awaits in each round gives its thread back, as one that awaits the future.

    :param implied: what its test shows.
    """
    world = machine.world
    if world.effects is None and not is_idle(loop) and not asks_for_service(loop.test):
        return
    place = frame.place(loop)
    retry_loops.begin(machine, loop, frame)
    _note_rest(machine, loop, frame)
    is_known = implied is not None and _note_things(machine, loop, frame, implied)
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
    """Whether the test asks something by the name of such a method; what it asks is noted."""
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
                if _others(machine, exits_of(machine, loop, frame), loop, frame):
                    owner = machine.mystery(_FIRST_OF, frame.place(loop))
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


_WAITS_FOR = {Word.PUT: 'Queue.get', Word.GET: 'Queue.put'}
"""Which wait lasts as long as a loop that asks again and again whether this was done."""


def _note_busy(
    machine: ConcurrentMachine,
    loop: ast.While,
    on: Value,
    seconds: Value | None,
    frame: Frame,
    word: Word = Word.SET,
) -> None:
    own = call_of_loop(loop, _WAITS_FOR.get(word, 'busy wait'), machine.world.activity)
    call = 'await' if _gives_back(machine, loop) else own
    effects = machine.world.effects
    behind = effects.behind if effects is not None else None
    machine.note_blocking(call, on, seconds, frame.place(loop))
    if effects is not None and call == WORKING_LOOP:
        effects.behind = behind  # what its rounds do comes before its end


def _gives_back(machine: ConcurrentMachine, loop: ast.While) -> bool:
    """Whether a coroutine that an executor runs gives its thread back in each round."""
    frees = machine.world.in_callback and not machine.world.on_loop
    is_turn = machine.world.turning and yields_each_round(loop.body)
    return frees and (awaits_each_round(loop) or is_turn)


def _note_things(
    machine: ConcurrentMachine, loop: ast.While, frame: Frame, implied: Implied
) -> bool:
    """Whether what happens to objects makes the test fail; the loop waits for that."""
    tests = exits_of(machine, loop, frame)
    place = frame.place(loop)
    why = Unknown('the loop also ends otherwise', place)
    is_timed = any(ends_otherwise(machine, test, loop, frame) for test in tests)
    seconds = Mystery(why) if is_timed else None
    needed, any_of_them = objects_of(implied.fails), objects_of(implied.breaks)
    if implied.is_either and any_of_them:
        things = choice([thing for thing, _ in any_of_them])
        _note_busy(machine, loop, things, seconds, frame)
    elif needed or (len(any_of_them) == 1 and not _others(machine, tests, loop, frame)):
        for thing, word in needed or any_of_them:
            _note_busy(machine, loop, thing, seconds, frame, word)
    elif any_of_them:
        first = machine.mystery(_FIRST_OF, place)
        _note_busy(machine, loop, first, seconds, frame)
    return bool(any_of_them)


def _others(
    machine: ConcurrentMachine, tests: list[ast.expr], loop: ast.While, frame: Frame
) -> bool:
    """Whether data or code that is not followed may end the loop too, beside an object."""
    parts = [part for test in tests for part in _operands(test)]
    plain = [part for part in parts if not _shows_end(machine, part, frame)]
    shown = tests_of_data(machine, plain, loop, frame)
    seen = seen_by(machine, shown, frame)
    is_open = bool(seen.names) or seen.outside is not None
    return is_open or end_of(machine, shown, loop, frame) is not End.DATA


def _operands(test: ast.expr) -> list[ast.expr]:
    """What is joined by ``and``, ``or`` and ``not``."""
    if isinstance(test, ast.BoolOp):
        return [part for each in test.values for part in _operands(each)]
    return _operands(test.operand) if isinstance(test, ast.UnaryOp) else [test]


def objects_of(facts: Facts) -> list[tuple[Value, Word]]:
    """In the order in which they were made."""
    found = dict(facts)
    return sorted(
        found.items(), key=lambda fact: fact[0].serial if isinstance(fact[0], Heaped) else 0
    )


def ends_otherwise(
    machine: ConcurrentMachine, test: ast.expr, loop: ast.While, frame: Frame
) -> bool:
    """Whether something may end the loop as well, beside what is asked of objects."""
    if isinstance(test, ast.BoolOp):
        return any(ends_otherwise(machine, each, loop, frame) for each in test.values)
    if isinstance(test, ast.UnaryOp):
        return ends_otherwise(machine, test.operand, loop, frame)
    if _shows_end(machine, test, frame):
        return False
    return runs_out(test, loop) or asks_for_cancel(test)


def _shows_end(machine: ConcurrentMachine, test: ast.expr, frame: Frame) -> bool:
    return asks_object(test) or implied_now(machine, test, frame) is not None


def implied_now(machine: ConcurrentMachine, test: ast.expr, frame: Frame) -> Implied | None:
    """What a test shows where it stands, without any note of what it reads."""
    world = machine.world
    noted, ready, world.effects = world.effects, world.ready, EffectLog()
    try:
        return implied_by(machine.evaluate(test, frame))
    finally:
        world.effects, world.ready = noted, ready


def _implied_by_exits(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> Implied | None:
    """What ends a loop whose test shows it only after a round, or stands inside."""
    for test in exits_of(machine, loop, frame):
        implied = implied_now(machine, test, frame)
        if implied is not None:
            return implied if test is loop.test else implied.negated()
    return None


def note(machine: ConcurrentMachine, loop: ast.While, frame: Frame, before: Mark) -> None:
    """After one round of ``loop``."""
    effects = machine.world.effects
    assert effects is not None
    _put_last(effects, before, frame.place(loop))
    _note_asked(machine, loop, effects, before, frame)
    _note_own_end(machine.world, loop, effects, before, frame)
    tests = exits_of(machine, loop, frame)
    exits = frozenset(map(frame.place, leaving_branches(loop)))
    effects.exits |= dict.fromkeys(map(frame.place, (loop, *tests[:1])), exits)
    if not tests and retry_loops.note(machine, loop, frame, before.waits):
        return
    asked = machine.world.reading.asked.get(frame.place(loop))
    inside = effects.blocking[before.waits :]
    if item_loops.note(machine, loop, frame):
        return
    if _only_asks(machine, inside) and message_loops.note(machine, loop, frame):
        return
    if any(map(_stands_for_the_loop, inside)) or endless_loops.note(machine, loop, frame):
        return
    if any(_is_guarded(block, asked) for block in inside):
        return
    implied = _implied_by_exits(machine, loop, frame)
    if implied is not None and _note_things(machine, loop, frame, implied):
        return
    if not tests:
        return
    asked_of_data = [test for test in tests if not asks_object(test)]
    seen = seen_by(machine, tests_of_data(machine, asked_of_data, loop, frame), frame)
    written = written_by_rounds(effects, before.writes, loop, frame)
    if seen.names & (written | set(effects.own[before.own :])):
        return
    known = len(effects.blocking)
    _note(machine, loop, frame, tests, seen, sent_up_to(effects, before.order))
    gives = any(isinstance(part, (ast.Yield, ast.YieldFrom)) for part in walk(loop))
    if gives and not _gives_back(machine, loop):
        reason = Unknown('what takes the items may change what the loop reads', frame.place(loop))
        effects.blocking[known:] = [
            replace(block, on=reason, resource=None, escapes=reason)
            for block in effects.blocking[known:]
        ]


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


def _put_last(effects: EffectLog, before: Mark, place: Place) -> None:
    """The end of a loop in which a thread works comes behind what its rounds wait for."""
    rounds = effects.blocking[before.waits :]
    own = [each for each in rounds if each.call == WORKING_LOOP and each.source == place]
    if own:
        others = [each for each in rounds if each not in own]
        known = {way_of(each) for each in effects.blocking[: before.waits]}
        effects.blocking[before.waits :] = (
            others if way_of(own[-1]) in known else [*others, own[-1]]
        )
        effects.behind = way_of(own[-1])


def _note_own_end(
    world: ConcurrentWorld, loop: ast.While, effects: EffectLog, before: Mark, frame: Frame
) -> None:
    """What works until it has set itself what it tests waits for nobody."""
    place, lines = frame.place(loop), range(loop.lineno, (loop.end_lineno or loop.lineno) + 1)
    for number, block in enumerate(effects.blocking[before.waits :], before.waits):
        is_loop = block.call in (WORKING_LOOP, 'busy wait')
        if not is_loop or not isinstance(block.resource, ResourceRef):
            continue
        wakings = world.wakings.get(block.resource.number, ())
        doer = world.activity or world.current
        own_places = [waking.place for waking in wakings if waking.by is doer]
        if any(each.file == place.file and each.line in lines for each in own_places):
            own = Unknown('the loop sets itself what ends it', place)
            effects.blocking[number] = replace(block, seconds=block.seconds or own)


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
        if block.call == 'Condition.wait' and seen_by(machine, [loop.test], frame).names:
            effects.blocking[number] = replace(block, conditional=True)


def _note(
    machine: ConcurrentMachine,
    loop: ast.While,
    frame: Frame,
    tests: list[ast.expr],
    seen: Seen,
    sent: frozenset[str],
) -> None:
    place = frame.place(tests[0])
    call = call_of_loop(loop, POLL, machine.world.activity)
    call = 'await' if _gives_back(machine, loop) else call
    shown = tests_of_data(machine, tests, loop, frame)
    end = end_of(machine, shown, loop, frame)
    is_waiting = only_passes_time(loop, tests)
    if end is End.ITSELF and not is_waiting:
        return  # it works, and looks at the data in between
    is_open = end is not End.ITSELF and (
        seen.outside is not None or (end is End.UNKNOWN and is_waiting)
    )
    if (none := asked_of_none(machine, shown, frame)) is not None:
        raises = Unknown(
            f'{ast.unparse(none)} is None, so that the test raises an exception', place
        )
        machine.note_loop_on_data(call, raises, None, place)
    elif seen.names and not is_open:
        reason = None if end is End.DATA else Unknown('the loop also ends otherwise', place)
        known = tests_of(machine, loop, tests, shown, frame)
        effects = machine.world.effects or EffectLog()
        before = frozenset((access.name, access.source) for access in effects.writes)
        for reference in _references(machine, seen, known, frame):
            reference.before = before
            reference.rise = rise_of(machine, shown, frame)
            reference.sent, reference.sent_by_now = sent, sent_by_now(effects)
            reference.minds_nothing = minds_nothing(loop)
            machine.note_loop_on_data(call, reference, reason, place)
    elif (is_open or end is End.DATA or only_sleeps(loop, tests)) and not any(
        asks_for_service(test) for test in tests
    ):
        if call == POLL and asks_outside(machine, tests, frame, seen):
            machine.note_blocking(ANSWER_LOOP, None, None, place)
            return
        text = ' or '.join(ast.unparse(test) for test in tests)
        unknown = Unknown(f'what ends the loop: {text}', place)
        machine.note_loop_on_data(call, unknown, None, place)


def _references(
    machine: ConcurrentMachine, seen: Seen, tests: tuple[LoopTest, ...], frame: Frame
) -> list[DataRef]:
    """What stands for the data; several where each of several tests must come out otherwise."""
    found = []
    for test, is_sure in needed_of(machine, tests, frame):
        names = test.formula.all_names & seen.names
        if names:
            part = reference_to(Seen(names, seen.holders, seen.outside), test.formula.item)
            part.tests, part.is_open_at_first = (test,), not is_sure
            found.append(part)
    whole = reference_to(seen)
    whole.tests = tests
    return found or [whole]


def reference_to(seen: Seen, item: str | None = None) -> DataRef:
    """What stands for the data, or an item of it, until a unit has given it a name."""
    name = min(seen.names)
    reference = DataRef(name if item is None else f'{name}[{item}]')
    reference.names, reference.holders = seen.names, seen.holders
    return reference


def _is_guarded(block: Blocking, asked: Asked | None) -> bool:
    """Whether the loop asks, under the lock of a condition, for what it waits on that for."""
    guard = block.resource.guard if isinstance(block.resource, ResourceRef) else None
    return guard is not None and asked is not None and guard.hold in asked.holds


def _stands_for_the_loop(block: Blocking) -> bool:
    """Whether a wait in its rounds lets others run, or is noted as the loop itself."""
    return block.call in ('busy wait', ANSWER_LOOP) or block.suspends or 'spin' in block.call


def _only_asks(machine: ConcurrentMachine, inside: Sequence[Blocking]) -> bool:
    """Whether its rounds wait for nothing but time, and for what it asks for itself."""
    return all(_is_pause(machine, b.call) or message_loops.is_asking(b.call) for b in inside)


def _is_pause(machine: ConcurrentMachine, call: str) -> bool:
    row = machine.model.waits.get(call)
    return call == 'Rate.sleep' or (row is not None and row.always == (TIME,))
