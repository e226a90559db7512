"""Statements that decide which others run: ``if``, ``match``, ``for``, ``while``."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from functools import partial

from ros2cc_extract.extract.static.program.generator_texts import yields_each_round
from ros2cc_extract.extract.static.python.branching import (
    correlated_tests,
    open_tests,
    parameter_branches,
)
from ros2cc_extract.extract.static.python.builtins import generators
from ros2cc_extract.extract.static.python.language import loops_as_while
from ros2cc_extract.extract.static.python.machine import path_facts
from ros2cc_extract.extract.static.python.machine.block_exits import BREAK, CONTINUE, NEXT, RETURN
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects import iterators, loops
from ros2cc_extract.extract.static.python.objects.allocation_sites import note_open_test
from ros2cc_extract.extract.static.python.values.values import Value
from ros2cc_extract.source_locations import Unknown


@contextmanager
def _loop(machine: Machine, frame: Frame) -> Iterator[None]:
    """A loop runs inside; afterwards what held at any ``break`` may hold."""
    outer = frame.breaks, frame.continues, frame.known_at_break
    frame.breaks, frame.continues, frame.known_at_break = [], [], []
    laps = machine.world.laps
    machine.world.laps = (*laps, object())
    try:
        yield
        machine.store.join([{}], frame.breaks)
    finally:
        frame.breaks, frame.continues, frame.known_at_break = outer
        machine.world.laps = laps


def _round(machine: Machine, body: Sequence[ast.stmt], frame: Frame) -> int:
    """Run the body of a loop once."""
    flow = machine.execute_block(body, frame)
    machine.store.join([{}], frame.continues)
    frame.continues.clear()
    return flow


def run_if(machine: Machine, node: ast.If, frame: Frame) -> int:
    """Run an ``if``, its ``elif`` among its arms."""
    holds = open_tests.decide_branch(machine, node, frame, node)
    if holds is not None:
        return machine.execute_block(node.body if holds else node.orelse, frame)
    note_open_test(machine.world, node.test, frame.place(node))
    asked = machine.world.tested
    bodies = _arms(machine, node, frame)
    if len(bodies) != len(('then', 'else')):
        parameter_branches.note_arms(machine, node.test, asked, frame.place(node))
        return machine.branches(bodies, frame.place(node), frame)
    place, is_opposite = correlated_tests.first_place(machine, node, frame)
    parameter_branches.note_arms(machine, node.test, asked, place, is_opposite=is_opposite)
    return machine.branches(bodies[::-1] if is_opposite else bodies, place, frame)


def _arms(machine: Machine, node: ast.If, frame: Frame) -> list[Callable[[], int]]:
    """The arms of an undecided ``if … elif … else`` as alternatives of one statement."""
    implied = path_facts.implied_by(machine.world.tested)
    so_far: tuple[path_facts.Implied, ...] = ()
    is_one_of_two = not (len(node.orelse) == 1 and isinstance(node.orelse[0], ast.If))
    arm = partial(_arm, machine, frame, is_one_of_two=is_one_of_two)
    arms: list[Callable[[], int]] = [arm(node.body, so_far, implied)]
    rest = node.orelse
    while len(rest) == 1 and isinstance(rest[0], ast.If):
        inner = rest[0]
        so_far = (*so_far, implied) if implied is not None else so_far
        holds = open_tests.decide_branch(machine, inner, frame, node)
        implied = path_facts.implied_by(machine.world.tested)
        if holds is not False:
            arms.append(arm(inner.body, so_far, implied))
        if holds is True:
            return arms
        rest = inner.orelse
    so_far = (*so_far, implied) if implied is not None else so_far
    arms.append(arm(rest, so_far, None))
    return arms


def _arm(
    machine: Machine,
    frame: Frame,
    body: Sequence[ast.stmt],
    fails: Sequence[path_facts.Implied],
    holds: path_facts.Implied | None,
    *,
    is_one_of_two: bool,
) -> Callable[[], int]:
    """An arm that is run where some tests have failed, and its own, if any, has held."""

    def run() -> int:
        for implied in fails:
            machine.world.assume(implied, holds=False)
        machine.world.assume(holds, holds=True)
        if is_one_of_two:
            skipped = holds.fails if holds is not None else fails[0].holds if fails else None
            machine.world.skipped_if[machine.world.path[-1]] = skipped or path_facts.NOTHING
        return machine.execute_block(body, frame)

    return run


def run_match(machine: Machine, node: ast.Match, frame: Frame) -> int:
    """Run a ``match``; each case may hold, and what it does rests on the subject."""
    open_tests.evaluate_subject(machine, node, frame)
    bodies: list[Callable[[], int]] = [
        lambda case=case: _case(machine, case, frame)  # type: ignore[misc]
        for case in node.cases
    ]
    if not any(_is_wildcard(case) for case in node.cases):
        bodies.append(lambda: NEXT)
    return machine.branches(bodies, frame.place(node), frame)


def _is_wildcard(case: ast.match_case) -> bool:
    pattern = case.pattern
    return case.guard is None and isinstance(pattern, ast.MatchAs) and pattern.pattern is None


def _case(machine: Machine, case: ast.match_case, frame: Frame) -> int:
    for part in ast.walk(case.pattern):
        name = getattr(part, 'name', None) or getattr(part, 'rest', None)
        if isinstance(name, str):
            unknown = machine.mystery('bound by a match pattern', frame.place(part), name)
            machine.assign(ast.Name(name, ast.Store()), unknown, frame)
    if case.guard is not None and open_tests.decide(machine, case.guard, frame) is False:
        return NEXT
    return machine.execute_block(case.body, frame)


def run_for(machine: Machine, node: ast.For | ast.AsyncFor, frame: Frame) -> int:
    """Run a ``for`` over what it goes over."""
    endless = loops_as_while.as_while(machine, node, frame)
    if endless is not None:
        return run_while(machine, endless, frame)
    place = frame.place(node.iter)
    counting = loops_as_while.counting(node)
    begun = machine.begin_rounds(counting) if counting is not None else None
    values = open_tests.evaluate_iterated(machine, node, frame)
    machine.note_for(node, frame)
    is_async = isinstance(node, ast.AsyncFor)
    values = iterators.iterated(machine, values, place, is_async=is_async)
    step = iterators.next_of(machine, values, place, is_async=is_async)
    rounds = values if step is None else machine.mystery('as many rounds as it gives items', place)
    is_driven = (machine.world.one_by_one or machine.world.turning) and yields_each_round(
        node.body
    )
    with generators.handed_on(machine) if is_driven else nullcontext():
        items = loops.items_to_run(machine, rounds, place)

    with (
        machine.world.left_anywhere(),
        _loop(machine, frame),
        machine.world.reading.in_loop(open_tests.asked_by_rounds(node, frame)),
    ):
        with nullcontext() if is_driven else loops.repeated(machine, items, node.body) as begin:

            def once(item: Value) -> int:
                if begin is not None:
                    begin(item)
                machine.assign(node.target, step() if step is not None else item, frame)
                machine.world.assume_picked(values, item)
                return _round(machine, node.body, frame)

            flow = loops.run_loop(machine, items, once, place)
        if counting is not None and begun is not None:
            machine.end_loop(counting, frame, begun)
        return _or_else(machine, node, flow, frame)


def _or_else(machine: Machine, node: ast.For | ast.AsyncFor, flow: int, frame: Frame) -> int:
    """Run what stands under ``else`` of a loop that ends by ``flow``, unless it is left."""
    left, rest = flow & BREAK, flow & ~(NEXT | BREAK)
    if not flow & NEXT or not node.orelse:
        return rest | (NEXT if flow & (NEXT | BREAK) else 0)

    def run() -> int:
        return machine.execute_block(node.orelse, frame)

    ends = machine.branches([run, lambda: NEXT], frame.place(node), frame) if left else run()
    return rest | ends


def run_while(machine: Machine, node: ast.While, frame: Frame) -> int:
    """Run a ``while``: one round of it, if it may have one."""
    node = loops_as_while.asked_by_method(machine, node, frame)
    holds, asked = open_tests.decide_loop(machine, node, frame)
    if holds is False or (holds is None and machine.is_over(node, frame)):
        return machine.execute_block(node.orelse, frame)
    implied, ready = path_facts.implied_by(machine.world.tested), machine.world.ready
    begun, stored = machine.begin_loop(node, frame, implied), machine.world.stored_by_now()
    reason = Unknown('made in a while loop', frame.place(node))
    with (
        loops.counted(machine, reason),
        _loop(machine, frame),
        machine.world.reading.in_loop(asked),
    ):
        machine.world.assume(implied, holds=True)
        open_tests.note_rounds(node, frame)
        flow = _round(machine, node.body, frame)
        ends = (
            []
            if holds
            else [ready | (implied.fails if implied is not None else path_facts.NOTHING)]
        )
        after = path_facts.of_all([*ends, *frame.known_at_break] or [ready])
    machine.world.ready = ready
    if not flow & (BREAK | RETURN):
        machine.note_endless(node, frame.place(node))
    if flow & (NEXT | CONTINUE):
        machine.end_loop(node, frame, begun)
    machine.world.ready = after | machine.world.stored_since(stored)
    return loops.after_loop(flow)
