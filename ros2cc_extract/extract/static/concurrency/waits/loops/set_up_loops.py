"""Loops of code that no callback runs: constructors and ``main``, before and while others spin."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.concurrency.waits.loops import message_loops, retry_loops
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_ends import (
    End,
    end_of,
    only_passes_time,
    seen_by,
    tests_of_data,
)
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import (
    asks_object,
    leaves,
    name_of,
    only_exit,
)
from ros2cc_extract.extract.static.concurrency.waits.loops.polling_loops import (
    POLL,
    ends_otherwise,
    implied_now,
    objects_of,
    reference_to,
)
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import note_loop
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import (
    is_endless,
    only_waits,
    spins,
)
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.objects.reachable_texts import reachable
from ros2cc_extract.extract.static.python.values.values import Mystery
from ros2cc_extract.source_locations import Unknown


def note(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> None:
    """After one round of ``loop``."""
    is_noted = message_loops.note(machine, loop, frame)
    if is_noted or retry_loops.note_in_set_up(machine, loop, frame):
        return
    _note_set_up(machine, loop, frame)
    _note_spinning(machine, loop, frame)


def _note_set_up(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> None:
    """Code that nobody serves looks at data again and again, and only sleeps meanwhile."""
    if asks_object(loop.test) and not leaves(loop):
        calls = (part for part in ast.walk(loop.test) if isinstance(part, ast.Call))
        machine.world.asked_until.update(frame.place(call) for call in calls)
    test = only_exit(loop)
    if test is None or asks_object(test) or not only_passes_time(loop, [test]):
        return
    tests = tests_of_data(machine, [test], loop, frame)
    if end_of(machine, tests, loop, frame) is not End.DATA:
        return
    seen = seen_by(machine, tests, frame)
    is_inside = test is not loop.test
    stays = _fails(machine, tests[0], frame) if is_inside else _holds(machine, tests[0], frame)
    if seen.names and seen.outside is None and stays:
        note_loop(machine.world, set(seen.names), frame.place(test))


def _note_spinning(machine: ConcurrentMachine, loop: ast.While, frame: Frame) -> None:
    """Code that no callback runs only spins or sleeps until something has changed."""
    if is_endless(loop) or not (only_waits(loop) or spins(loop)):
        return
    world = machine.world
    end = getattr(loop, 'end_lineno', None) or loop.lineno
    place = frame.place(loop)
    spun = world.served_within(place.file, loop.lineno, end)
    implied = implied_now(machine, loop.test, frame)
    things = objects_of(implied.fails | implied.breaks) if implied is not None else []
    if things:
        is_timed = ends_otherwise(machine, loop.test, loop, frame)
        why = Mystery(Unknown('the loop also ends otherwise', place)) if is_timed else None
        for thing, _ in things if spun else ():
            machine.note_outside_wait('busy wait', thing, why, place, spun)
        return
    tests = tests_of_data(machine, [loop.test], loop, frame)
    seen = seen_by(machine, tests, frame)
    if seen.names:
        is_data = end_of(machine, tests, loop, frame) is End.DATA and seen.outside is None
        is_data = is_data and (only_waits(loop) or _leaves_to_others(world, loop, seen.names))
        reason = Unknown('the loop also ends otherwise', place)
        reference = reference_to(seen)
        machine.note_loop_on_data(POLL, reference, None if is_data else reason, place, spun)


def _leaves_to_others(world: ConcurrentWorld, loop: ast.While, names: frozenset[str]) -> bool:
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


def _fails(machine: ConcurrentMachine, test: ast.expr, frame: Frame) -> bool:
    return machine.truth(machine.evaluate(test, frame)) is False
