"""
What a test of a copy has found: ``port = self.port``, then ``if port is None``.

The copy tells what was there when it was read. So it must be read anew in each round of a loop
in which it is tested, and the code must not have stored anything itself since then.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Mapping

from ros2cc_extract.extract.static.concurrency.accesses.flags import flag_locks
from ros2cc_extract.extract.static.concurrency.accesses.holders.closure_cells import is_own_name
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.values.values import FunctionNode
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import FLAG
from ros2cc_extract.spec.program_order import steps

_LOOPS = (ast.For, ast.AsyncFor, ast.While)


@dataclass(frozen=True)
class _Text:
    """
    What the text of a function says.

    :param copied: names that are stored once, as a copy of an attribute, with the loop around.
    :param loops: the innermost loop around each ``if``, by the identity of both.
    """

    copied: Mapping[str, tuple[ast.Attribute, int]]
    loops: Mapping[int, int]


def note_test(machine: ConcurrentMachine, node: ast.If, place: Place, frame: Frame) -> None:
    """Note what the copies that ``node`` asks for were found to be, on each of its arms."""
    if frame.function is None or isinstance(frame.function.node, ast.Lambda):
        return
    text = noted_on(frame.function.node, 'copied', _text_of)
    reading = machine.world.reading
    arms = flag_locks.steps_of(node)
    asked = flag_locks.asked_in(
        node.test, lambda each: flag_locks.constant_text(machine, each, frame)
    )
    for name, if_true, value in asked:
        copied, loop = text.copied.get(name, (None, 0))
        if copied is None or loop != text.loops.get(id(node)) or not is_own_name(name, frame):
            continue
        data = _copied_data(machine, copied, frame)
        for step in arms[if_true] if data is not None else ():
            known = reading.found.setdefault((place, step), {})
            known.setdefault(data or '', value)


def _copied_data(machine: ConcurrentMachine, copied: ast.Attribute, frame: Frame) -> str | None:
    """The shared data that was copied there, unless the code has stored it since."""
    effects = machine.world.effects
    if effects is None:
        return None
    place = frame.place(copied)
    reads = [
        read
        for read in effects.reads
        if read.source == place and read.name.rpartition('.')[2] == copied.attr
    ]
    if len(reads) != 1:
        return None
    name, at = reads[0].name, steps(reads[0])
    is_stored = any(write.name == name and steps(write) > at for write in effects.writes)
    return None if is_stored or name.endswith(FLAG) else name


def _text_of(function: FunctionNode) -> _Text:
    stored = Counter(
        part.id
        for part in walk(function)
        if isinstance(part, ast.Name) and not isinstance(part.ctx, ast.Load)
    )
    copied: dict[str, tuple[ast.Attribute, int]] = {}
    loops: dict[int, int] = {}
    waiting: list[tuple[ast.AST, int]] = [(function, 0)]
    while waiting:
        part, loop = waiting.pop()
        if isinstance(part, ast.If):
            loops[id(part)] = loop
        elif isinstance(part, ast.Assign) and isinstance(part.value, ast.Attribute):
            for target in part.targets:
                if isinstance(target, ast.Name) and stored[target.id] == 1:
                    copied[target.id] = part.value, loop
        inner = id(part) if isinstance(part, _LOOPS) else loop
        waiting += [(each, inner) for each in ast.iter_child_nodes(part)]
    return _Text(copied, loops)
