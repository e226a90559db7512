"""``try``: its body runs as if nothing went wrong, unless a call in it cannot succeed."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from itertools import chain

from ros2cc_extract.extract.static.python.machine.block_exits import DEAD, LEAVING, NEXT
from ros2cc_extract.extract.static.python.machine.frame import CannotCallError, Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.path_facts import Facts
from ros2cc_extract.extract.static.python.values.caught_errors import Caught


def run_try(machine: Machine, node: ast.Try, frame: Frame) -> int:
    """Body, ``else`` and ``finally`` run as if nothing went wrong; handlers are branches."""

    def regular() -> int:
        flow = machine.execute_block(node.body, frame)
        if flow & NEXT and node.orelse:
            flow = (flow & ~NEXT) | machine.execute_block(node.orelse, frame)
        return flow

    path, ready = machine.world.path, machine.world.ready
    begun = machine.world.stored_by_now()
    try:
        with (
            _trying(machine, any(_catches_type_error(each) for each in node.handlers)),
            catching(machine, _caught_by(node.handlers)),
        ):
            flow = regular()
    except CannotCallError:
        caught = next(each for each in node.handlers if _catches_type_error(each))
        machine.world.ready |= machine.world.stored_since(begun)
        flow = _run_handler(machine, caught, frame)
        return _finally(machine, node, frame, flow, begun)
    stopped, machine.world.stopped = machine.world.stopped, False
    machine.world.path = path
    if node.handlers:
        known = ready | machine.world.stored_since(begun)
        flow = _handle(machine, node, frame, known, DEAD if stopped else flow)
        stopped = False
    flow = _finally(machine, node, frame, flow, begun)
    machine.world.stopped = machine.world.stopped or stopped
    return flow


def _finally(machine: Machine, node: ast.Try, frame: Frame, flow: int, begun: int) -> int:
    if not node.finalbody:
        return flow
    machine.world.ready |= machine.world.stored_since(begun)
    final = machine.execute_block(node.finalbody, frame)
    return flow if final & NEXT else final


@contextmanager
def _trying(machine: Machine, catches: bool) -> Iterator[None]:
    """Leave out calls directly inside that surely raise ``TypeError``, if it is caught."""
    before = machine.world.trying
    machine.world.trying = (len(machine.stack), machine.store.depth) if catches else None
    try:
        yield
    finally:
        machine.world.trying = before


@contextmanager
def catching(machine: Machine, caught: frozenset[str]) -> Iterator[None]:
    """What is raised inside may be caught, or is raised only because something else was."""
    before = machine.world.caught
    machine.world.caught = (*before, caught) if caught else before
    try:
        yield
    finally:
        machine.world.caught = before


_ANYTHING = 'BaseException'
_LACKING = frozenset({'IndexError', 'KeyError', 'LookupError', 'Exception', _ANYTHING})
_TYPE_ERRORS = frozenset({'TypeError', 'Exception', _ANYTHING})


def _caught_by(handlers: Sequence[ast.ExceptHandler]) -> frozenset[str]:
    return frozenset(chain.from_iterable(_names_of(handler) for handler in handlers))


def _names_of(handler: ast.ExceptHandler) -> Iterator[str]:
    """What a handler catches; ``socket.timeout`` as it is written."""
    kinds = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    for kind in kinds:
        yield _ANYTHING if kind is None else ast.unparse(kind)


def _own_names_of(handler: ast.ExceptHandler, frame: Frame) -> Iterator[str]:
    """The same; nothing for a name to which the program has given another meaning."""
    return ('' if name in frame.module.slots else name for name in _names_of(handler))


def is_lack_uncaught(machine: Machine) -> bool:
    """Whether nobody catches that there is no such item."""
    return all(_LACKING.isdisjoint(caught) for caught in machine.world.caught)


def _catches_type_error(handler: ast.ExceptHandler) -> bool:
    return not _TYPE_ERRORS.isdisjoint(_names_of(handler))


def _run_handler(machine: Machine, handler: ast.ExceptHandler, frame: Frame) -> int:
    """Run a handler; what it cannot call ends it."""
    if handler.name:
        text = handler.name
        caught = Caught(frame.place(handler), text, _own_names_of(handler, frame))
        machine.assign(ast.Name(text, ast.Store()), caught, frame)
    held = machine.given_back_in(handler.body)
    machine.world.held = tuple(dict.fromkeys((*machine.world.held, *held)))
    try:
        with _trying(machine, catches=True), catching(machine, frozenset({_ANYTHING})):
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
