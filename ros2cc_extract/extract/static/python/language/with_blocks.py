"""Blocks of ``with``: what is entered, what runs inside, and what the end of the block does."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import ExecutorState, PlainState
from ros2cc_extract.extract.static.python.values.values import NONE, Bound, Call, Instance, Value
from ros2cc_extract.places import Place


def run_with(machine: Machine, node: ast.With | ast.AsyncWith, frame: Frame) -> int:
    """Run a block, with what its objects do at its begin and its end."""
    held = machine.world.held
    entered_ones: list[tuple[Value, Value, Place]] = []
    try:
        for item in node.items:
            value, place = (
                machine.evaluate(item.context_expr, frame),
                frame.place(item.context_expr),
            )
            entered = machine.enter_context(value, place)
            if item.optional_vars is not None:
                machine.assign(item.optional_vars, entered, frame)
            entered_ones.append((value, entered, place))
        flow = machine.execute_block(node.body, frame)
        for value, entered, place in reversed(entered_ones):
            machine.leave_context(entered, place)
            _exit(machine, value, _end_of(node, place))
        return flow
    finally:
        machine.world.held = machine.held_behind_block(held)


def _exit(machine: Machine, value: Value, place: Place) -> None:
    """What the ``__exit__`` of a class of the program does."""
    if not isinstance(value, Instance) or isinstance(value.state, (PlainState, ExecutorState)):
        return
    method = machine.attribute(value, '__exit__', place)
    if isinstance(method, Bound):
        machine.call(method, Call(place, [NONE, NONE, NONE]))


def _end_of(node: ast.With | ast.AsyncWith, begin: Place) -> Place:
    """Behind all that is done in the block, for the order of what is done."""
    return Place(begin.file, node.end_lineno or node.lineno, (node.end_col_offset or 0) + 1)
