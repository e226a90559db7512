"""Blocks of ``with``: what is entered, what runs inside, and what the end of the block does."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.builtins import generators
from ros2cc_extract.extract.static.python.language.try_blocks import catching
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Generator, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Coroutine,
    Instance,
    Native,
    Value,
    choice,
)
from ros2cc_extract.source_locations import Place

_PLAIN, _ASYNC = ('__enter__', '__exit__'), ('__aenter__', '__aexit__')


class Blocks(Machine):
    """What a block begins with."""

    def enter_context(self, value: Value, place: Place, *, is_async: bool = False) -> Value:
        """What ``with value as x`` binds to ``x``, or ``async with``."""
        if is_async and not isinstance(value, Instance):
            self.note_suspended(place)
        if isinstance(value, Instance):
            if is_block(value):
                self.note_entered(value, place)
                return value
            name = _ASYNC[0] if is_async else _PLAIN[0]
            method = self.attribute(value, name, place)
            if isinstance(method, (Bound, Native)):
                entered = self.run_if_coroutine(self.call(method, Call(place)), place)
                self.note_lock_method(value, name)
                return entered
            return value
        return self._enter_generator(value, place)

    def _enter_generator(self, value: Value, place: Place) -> Value:
        """
        A generator under ``contextmanager`` stops at its ``yield`` until the block is left.

        Source: ``contextlib.py``. It is run to its end here, so its locks were given back.
        """
        if isinstance(value, Coroutine):
            value = self.run_if_coroutine(value, place)
        generators.run(self, value, place)
        made, held = self.world.yielding or (None, ())
        if isinstance(value, Generator):
            made, held = value, value.slots.get('held', ())
        if value is not made or not isinstance(value, Sequence):
            return value
        self.world.held = tuple(dict.fromkeys((*self.world.held, *held)))
        return choice(list(value.items)) if value.items else value


def is_block(value: Instance) -> bool:
    """Whether its library says what a ``with`` does."""
    return isinstance(value.state, LibraryState) and value.state.is_block


def run_with(machine: Machine, node: ast.With | ast.AsyncWith, frame: Frame) -> int:
    """Run a block, with what its objects do at its begin and its end."""
    held, is_async = machine.world.held, isinstance(node, ast.AsyncWith)
    entered_ones: list[tuple[Value, Value, Place]] = []
    try:
        for item in node.items:
            value, place = (
                machine.evaluate(item.context_expr, frame),
                frame.place(item.context_expr),
            )
            entered = machine.enter_context(value, place, is_async=is_async)
            if item.optional_vars is not None:
                machine.assign(item.optional_vars, entered, frame)
            entered_ones.append((value, entered, place))
        with catching(machine, _suppressed(node)):
            flow = machine.execute_block(node.body, frame)
        for value, entered, place in reversed(entered_ones):
            machine.note_left_block(entered, place)
            _exit(machine, value, _end_of(node, place), is_async=is_async)
        return flow
    finally:
        machine.world.held = machine.held_behind_block(held)


def _suppressed(node: ast.With | ast.AsyncWith) -> frozenset[str]:
    """The exceptions that ``contextlib.suppress`` catches, as they are written."""
    calls = [each.context_expr for each in node.items if isinstance(each.context_expr, ast.Call)]
    suppressing = [each for each in calls if ast.unparse(each.func).endswith('suppress')]
    return frozenset(ast.unparse(name) for each in suppressing for name in each.args)


def _exit(machine: Machine, value: Value, place: Place, *, is_async: bool) -> None:
    """What the ``__exit__`` of a class does."""
    if not isinstance(value, Instance) or is_block(value):
        return
    method = machine.attribute(value, _ASYNC[1] if is_async else _PLAIN[1], place)
    if isinstance(method, (Bound, Native)):
        left = machine.call(method, Call(place, [NONE, NONE, NONE]))
        machine.run_if_coroutine(left, place)


def _end_of(node: ast.With | ast.AsyncWith, begin: Place) -> Place:
    """Behind all that is done in the block, for the order of what is done."""
    return Place(begin.file, node.end_lineno or node.lineno, (node.end_col_offset or 0) + 1)
