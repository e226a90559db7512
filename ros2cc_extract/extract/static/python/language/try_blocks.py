"""``try``: its body runs as if nothing went wrong, unless a call in it cannot succeed."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from ros2cc_extract.extract.static.python.machine.block_exits import DEAD, LEAVING, NEXT
from ros2cc_extract.extract.static.python.machine.frame import CannotCallError, Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.path_facts import Facts


def run_try(machine: Machine, node: ast.Try, frame: Frame) -> int:
    """Body, ``else`` and ``finally`` run as if nothing went wrong; handlers are branches."""

    def regular() -> int:
        flow = machine.execute_block(node.body, frame)
        if flow & NEXT and node.orelse:
            flow = (flow & ~NEXT) | machine.execute_block(node.orelse, frame)
        return flow

    path, ready = machine.world.path, machine.world.ready
    try:
        is_caught = bool(node.handlers)
        with (
            _trying(machine, any(_catches_type_error(each) for each in node.handlers)),
            _catching(machine, is_caught),
        ):
            flow = regular()
    except CannotCallError:
        caught = next(each for each in node.handlers if _catches_type_error(each))
        flow = _run_handler(machine, caught, frame)
        return _finally(machine, node, frame, flow)
    stopped, machine.world.stopped = machine.world.stopped, False
    machine.world.path = path
    if node.handlers:
        flow = _handle(machine, node, frame, ready, DEAD if stopped else flow)
        stopped = False
    flow = _finally(machine, node, frame, flow)
    machine.world.stopped = machine.world.stopped or stopped
    return flow


def _finally(machine: Machine, node: ast.Try, frame: Frame, flow: int) -> int:
    if not node.finalbody:
        return flow
    final = machine.execute_block(node.finalbody, frame)
    return flow if final & NEXT else final


@contextmanager
def _trying(machine: Machine, catches: bool) -> Iterator[None]:
    """Calls directly inside that surely raise ``TypeError`` are left, where somebody takes it."""
    before = machine.world.trying
    machine.world.trying = (len(machine.stack), machine.store.depth) if catches else None
    try:
        yield
    finally:
        machine.world.trying = before


@contextmanager
def _catching(machine: Machine, catches: bool) -> Iterator[None]:
    """What is raised inside may be caught, or is raised only because something else was."""
    machine.world.tries += catches
    try:
        yield
    finally:
        machine.world.tries -= catches


_TYPE_ERRORS = frozenset({'TypeError', 'Exception', 'BaseException'})


def _catches_type_error(handler: ast.ExceptHandler) -> bool:
    kinds = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    return any(
        kind is None or (isinstance(kind, ast.Name) and kind.id in _TYPE_ERRORS) for kind in kinds
    )


def _run_handler(machine: Machine, handler: ast.ExceptHandler, frame: Frame) -> int:
    """Run a handler; what it cannot call ends it."""
    if handler.name:
        text = handler.name
        caught = machine.mystery('a caught exception', frame.place(handler), text)
        machine.assign(ast.Name(text, ast.Store()), caught, frame)
    held = machine.given_back_in(handler.body)
    machine.world.held = tuple(dict.fromkeys((*machine.world.held, *held)))
    try:
        with _trying(machine, catches=True), _catching(machine, catches=True):
            return machine.execute_block(handler.body, frame)
    except CannotCallError:
        return DEAD


def _handle(machine: Machine, node: ast.Try, frame: Frame, ready: Facts, flow: int) -> int:
    """
    Run the handlers after the body; each is a branch of its own.

    :param ready: what had happened before, which is all that a handler knows.
    """
    bodies: list[Callable[[], int]] = [lambda: flow]

    def run(handler: ast.ExceptHandler) -> int:
        machine.world.ready = ready
        return _run_handler(machine, handler, frame)

    bodies += [partial(run, handler) for handler in node.handlers]
    ends = machine.branches(bodies, frame.place(node), frame)
    return ends & ~LEAVING if flow & NEXT else ends
