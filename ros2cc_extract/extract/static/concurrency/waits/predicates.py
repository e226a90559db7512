"""
What the predicate of ``Condition.wait_for`` reads, which is asked anew after each wake-up.

CPython 3.12, ``threading.py``: ``wait_for`` is a loop around ``wait`` that asks its predicate
under the lock until it is true. What others have stored meanwhile only ends that wait, or does
not. So it is no value that the run reads back, unless the outcome is used, or the predicate keeps
what it has found.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.world import note_once
from ros2cc_extract.extract.static.python.values.values import Call, FunctionNode
from ros2cc_extract.spec.effects import Access


@contextmanager
def asked_again(machine: ConcurrentMachine, call: Call) -> Iterator[None]:
    """A predicate is followed: what it reads shows nothing but whether to go on waiting."""
    effects = machine.world.effects
    machine.world.let_others_store()
    if effects is None or not _only_ends_wait(machine, call):
        yield
        return
    begun, kept = len(effects.reads), (len(effects.writes), len(effects.own))
    yield
    if (len(effects.writes), len(effects.own)) == kept:
        found: list[Access] = effects.reads[begun:]
        del effects.reads[begun:]
        for read in found:
            note_once(effects.reads, replace(read, fresh=True))


def _only_ends_wait(machine: ConcurrentMachine, call: Call) -> bool:
    """Whether the result is dropped, or only a loop goes on because of it."""
    caller = machine.stack[-1] if machine.stack else None
    if caller is None or caller.place.file != call.place.file:
        return False
    at = call.place.line, call.place.column
    return at in noted_on(caller.node, 'dropped', _dropped)


def _dropped(node: FunctionNode) -> frozenset[tuple[int | None, int | None]]:
    """Where the calls stand whose results are not used."""
    found = set()
    for part in walk(node):
        value = part.value if isinstance(part, ast.Expr) else None
        if isinstance(part, ast.While):
            value = part.test
            while isinstance(value, ast.UnaryOp) and isinstance(value.op, ast.Not):
                value = value.operand
        if isinstance(value, ast.Call):
            found.add((value.lineno, value.col_offset + 1))
    return frozenset(found)
