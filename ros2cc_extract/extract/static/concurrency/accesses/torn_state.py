"""
Attributes, or items of one container, that are written one after the other while others may run.

``self.x = msg.x; self.y = msg.y``: code that runs in between finds a new one beside an old one.
Others may run in between where the function waits there, calls one of the program, or takes the
second from an argument: CPython may switch threads where a function begins, and the fields of a
message are properties written in Python (``*.py`` that rosidl_generator_py makes, Jazzy). Two
values are of one thing where the source names it in both.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.machine.dependences import Reading
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.recorded_effects import Stored
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.values.values import Const


@contextmanager
def noted(reading: Reading, node: ast.Assign | ast.AugAssign, frame: Frame) -> Iterator[None]:
    """While the statement is followed, it is known from which arguments its value is taken."""
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    # All values of ``self.x, self.y = msg.x, msg.y`` are there before the first is stored.
    is_one = any(isinstance(target, (ast.Tuple, ast.List)) for target in targets)
    before = reading.taken_from, reading.named
    reading.taken_from = frozenset() if is_one else _taken_from(node.value, frame)
    reading.named = frozenset(ast.unparse(part) for part in ast.walk(node.value) if _names(part))
    try:
        yield
    finally:
        reading.taken_from, reading.named = before


def _names(part: ast.AST) -> bool:
    """A name, but for that of the object itself, or an attribute of it."""
    if isinstance(part, ast.Attribute):
        return isinstance(part.value, ast.Name)
    return isinstance(part, ast.Name) and part.id != 'self'


def _taken_from(value: ast.expr, frame: Frame) -> frozenset[str]:
    """The arguments that something is asked for in ``value``."""
    if frame.function is None or not isinstance(frame.function.node, ast.FunctionDef):
        return frozenset()
    arguments = {argument.arg for argument in frame.function.node.args.args[1:]}
    return frozenset(
        part.value.id
        for part in ast.walk(value)
        if isinstance(part, ast.Attribute)
        and isinstance(part.value, ast.Name)
        and part.value.id in arguments
    )


def written_with(
    world: ConcurrentWorld, name: str, item: str | None, kind: AccessKind
) -> tuple[str | None, bool]:
    """
    The attribute that was written before ``name``, and whether both are of one thing.

    :param item: of the container ``name``, which is stored where that is updated in place.
    """
    effects, reading = world.effects, world.reading
    if kind is AccessKind.WRITE:
        item = None
    elif kind is not AccessKind.UPDATE_IN_PLACE or item is None or world.moves is not None:
        return None, False
    if effects is None or _is_flag(reading):
        return None, False  # who finds it up finds what was stored before
    whose = (name if item is not None else name.rpartition('.')[0]), world.chain
    before = effects.stored_last.get(whose)
    now = Stored(
        name, item, world.path, effects.behind, reading.taken_from, reading.named, effects.begun
    )
    effects.stored_last[whose] = now
    if before is None or (before.name, before.item) == (name, item) or before.path != now.path:
        return None, False
    is_parted = (before.behind, before.begun) != (now.behind, now.begun)
    is_parted = is_parted or not before.taken_from.isdisjoint(now.taken_from)
    return (before.name, _are_akin(before, now)) if is_parted else (None, False)


def _are_akin(before: Stored, now: Stored) -> bool:
    """Whether the source names one thing in both values, or takes the second from the first."""
    first = before.name.rpartition('.')[2]
    is_from = any(named.rpartition('.')[2] == first for named in now.named)
    return is_from or not before.named.isdisjoint(now.named)


def _is_flag(reading: Reading) -> bool:
    """A constant is stored, and no name stands for a measure that is known by chance."""
    stored = reading.stored
    is_measure = isinstance(stored, Const) and isinstance(stored.value, float)
    return isinstance(stored, Const) and not (is_measure and reading.named)
