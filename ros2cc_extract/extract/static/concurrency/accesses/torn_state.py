"""
Attributes that are written one after the other and belong together.

``self.x = msg.x; self.y = msg.y``: code that runs in between finds a new one beside an old one.
They belong together where both are taken from one argument of the function, or where it waits
between the two. CPython may switch threads in between, as the fields of a message are properties
written in Python (``*.py`` that rosidl_generator_py makes, Jazzy).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.machine.dependences import Reading
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.recorded_effects import Stored
from ros2cc_extract.extract.static.python.values.values import Const


@contextmanager
def noted(reading: Reading, node: ast.Assign | ast.AugAssign, frame: Frame) -> Iterator[None]:
    """While the statement is followed, it is known from which arguments its value is taken."""
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    # All values of ``self.x, self.y = msg.x, msg.y`` are there before the first is stored.
    is_one = any(isinstance(target, (ast.Tuple, ast.List)) for target in targets)
    before = reading.taken_from
    reading.taken_from = frozenset() if is_one else _taken_from(node.value, frame)
    try:
        yield
    finally:
        reading.taken_from = before


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


def written_with(world: ConcurrentWorld, name: str) -> str | None:
    """The attribute that was written before ``name``, and belongs with it."""
    effects, reading = world.effects, world.reading
    if effects is None or isinstance(reading.stored, Const):
        return None  # as a flag: who finds it up finds what was stored before
    whose = name.rpartition('.')[0], world.chain
    before = effects.stored_last.get(whose)
    now = Stored(name, world.path, effects.behind, reading.taken_from)
    effects.stored_last[whose] = now
    if before is None or before.name == name or before.path != now.path:
        return None
    is_together = before.behind != now.behind or not before.taken_from.isdisjoint(now.taken_from)
    return before.name if is_together else None
