"""
Loops that try again until no error is raised.

``while True: try: return self.queue.get_nowait() except Empty: time.sleep(0.1)`` waits for what
makes the attempt succeed. A handler that does more than to sleep and log may see to that itself:
such a loop is left. Which calls raise when their time is over: CPython 3.12, ``queue.py``,
``concurrent/futures/_base.py``, ``subprocess.py``; rclpy 9.1.2, ``client.py``.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import DataRef
from ros2cc_extract.extract.static.concurrency.waits.loops import message_loops
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import (
    LEAVES,
    name_of,
    own_parts,
)
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import passes_time
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import OUTSIDE, POLLING_LOOP, Blocking

RAISE_WHEN_OVER = frozenset(
    ['Queue.get', 'Queue.put', 'Future.result', 'Future.exception', 'client.call', 'Popen.wait']
)
"""Waits that are tried again when their time is over."""
_OF_QUEUES = frozenset(['get', 'get_nowait', 'put', 'put_nowait'])
_TAKES_OUT = frozenset(['pop', 'popleft', 'popitem', 'index', 'remove'])
"""Methods of plain data that raise where there is nothing."""


def begin(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> None:
    """What a queue refuses at once, and a loop tries until it succeeds, is waited for."""
    attempt = _attempt(loop) if machine.world.in_callback else None
    if attempt is None:
        return
    parts = (part for statement in attempt.body for part in walk(statement))
    calls = [part for part in parts if isinstance(part, ast.Call) and name_of(part) in _OF_QUEUES]
    if len(calls) == 1:
        machine.world.retried.add(frame.place(calls[0]))


def note(machine: ConcurrentMachine, loop: ast.While, frame: Frame, first: int) -> bool:
    """
    Note what a loop waits for that ends only when an attempt succeeds; whether it is one.

    :param first: how many waits had been noted when it began.
    """
    attempt = _attempt(loop)
    effects = machine.world.effects
    if attempt is None or effects is None or not machine.world.in_callback:
        return False
    if message_loops.note_attempt(machine, loop, list(_tried(attempt)), frame):
        return True
    if _has_timed_waits(effects, first, attempt, frame):
        return True
    if _asks_outside(machine, effects, first, attempt, frame):
        return True  # each round waits for that, which is told
    place = frame.place(loop)
    tried = list(_tried(attempt))
    names = _read(machine, tried, frame)
    if names and _only_takes_out(tried):
        reference = DataRef(sorted(names)[0])
        reference.names = frozenset(names)
        reference.before = frozenset((write.name, write.source) for write in effects.writes)
        machine.note_loop_on_data(POLLING_LOOP, reference, None, place)
        return True
    text = '; '.join(ast.unparse(each) for each in tried) or 'the attempt'
    why = Unknown(f'when {text} raises no error', place)
    machine.note_loop_on_data(POLLING_LOOP, why, None, place)
    return True


def note_in_set_up(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> bool:
    """Tell of a loop of the set-up whose attempt succeeds when messages have come."""
    attempt = _attempt(loop)
    if attempt is None:
        return False
    return message_loops.note_attempt(machine, loop, list(_tried(attempt)), frame)


def _attempt(loop: ast.While) -> ast.Try | None:
    """The only statement that leaves a loop, where every error in it leads to another round."""
    trying = [each for each in loop.body if isinstance(each, ast.Try)]
    if len(trying) != 1 or not trying[0].handlers:
        return None
    (attempt,) = trying
    inside = set(_leaves_of([*attempt.body, *attempt.orelse]))
    is_all = set(_leaves_of(loop.body)) == inside
    pauses = all(passes_time(handler.body) for handler in attempt.handlers)
    return attempt if inside and is_all and pauses else None


def _leaves_of(body: Sequence[ast.stmt]) -> Iterator[ast.AST]:
    return (part for part in own_parts(body) if isinstance(part, LEAVES))


def _has_timed_waits(effects: EffectLog, first: int, attempt: ast.Try, frame: Frame) -> bool:
    """What raises when its time is over and is tried again has no time-out."""
    is_any = False
    for number, block in enumerate(effects.blocking[first:], first):
        if _stands_in(block, attempt, frame) and block.call in RAISE_WHEN_OVER:
            is_any = True
            effects.blocking[number] = replace(block, seconds=None, assumed=None)
    return is_any


def _asks_outside(
    machine: ConcurrentMachine, effects: EffectLog, first: int, attempt: ast.Try, frame: Frame
) -> bool:
    """Whether the attempt waits without a time-out for somebody outside, as a person."""
    rows = (
        machine.model.waits.get(block.call)
        for block in effects.blocking[first:]
        if block.seconds is None and _stands_in(block, attempt, frame)
    )
    return any(row is not None and OUTSIDE in row.always for row in rows)


def _stands_in(block: Blocking, attempt: ast.Try, frame: Frame) -> bool:
    lines = range(attempt.lineno, attempt.handlers[0].lineno)
    at = block.source
    return at is not None and at.file == frame.place(attempt).file and at.line in lines


def _tried(attempt: ast.Try) -> Iterator[ast.expr]:
    """What is computed before the loop is left."""
    for statement in attempt.body:
        value = getattr(statement, 'value', None)
        if isinstance(value, ast.expr) and not isinstance(value, (ast.Name, ast.Constant)):
            yield value


def _only_takes_out(tried: Sequence[ast.expr]) -> bool:
    calls = (part for each in tried for part in walk(each) if isinstance(part, ast.Call))
    return all(name_of(call) in _TAKES_OUT for call in calls)


def _read(machine: ConcurrentMachine, tried: Sequence[ast.expr], frame: Frame) -> set[str]:
    """Names of the shared data that the attempt reads."""
    world = machine.world
    noted, world.effects = world.effects, EffectLog()
    try:
        for each in tried:
            machine.evaluate(each, frame)
        return {access.name for access in (*world.effects.reads, *world.effects.writes)}
    finally:
        world.effects = noted
