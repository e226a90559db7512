"""
How many writes it takes until a loop on plain data goes on.

``while self.arrived < 2: time.sleep(0.1)`` goes on behind the second ``self.arrived += 1``.
A callback that adds one and then waits itself has not ended the loop.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.counters import Rise, Step, is_number
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.values.values import Const, Instance


def rise_of(machine: ConcurrentMachine, tests: Sequence[ast.expr], frame: Frame) -> Rise | None:
    """What the only test of a loop asks of a number, if it does: ``self.arrived < 2``."""
    test = tests[0] if len(tests) == 1 else None
    if not isinstance(test, ast.Compare) or len(test.ops) != 1:
        return None
    asked, limit = test.left, machine.evaluate(test.comparators[0], frame)
    if not isinstance(asked, ast.Attribute) or not is_number(getattr(limit, 'value', None)):
        return None
    owner = machine.evaluate(asked.value, frame)
    assert isinstance(limit, Const)
    if not isinstance(owner, Instance) or not isinstance(test.ops[0], (ast.Lt, ast.LtE)):
        return None
    least = limit.value + (1 if isinstance(test.ops[0], ast.LtE) else 0)
    return Rise(owner, frame.attribute_name(asked.attr), least)


def note_step(machine: ConcurrentMachine, node: ast.Assign | ast.AugAssign, frame: Frame) -> None:
    """A number grows: ``self.arrived += 1``."""
    effects, added = machine.world.effects, _added(node)
    if effects is None or added is None:
        return
    place = frame.place(node.target if isinstance(node, ast.AugAssign) else node.targets[0])
    is_first = place not in effects.steps and not effects.loops and not machine.world.open_loops
    if isinstance(added, ast.Constant) and isinstance(added.value, (int, float)):
        effects.steps[place] = Step(added.value, repeats=not is_first)


def _added(node: ast.Assign | ast.AugAssign) -> ast.expr | None:
    if isinstance(node, ast.AugAssign):
        return node.value if isinstance(node.op, ast.Add) else None
    value = node.value
    is_sum = isinstance(value, ast.BinOp) and isinstance(value.op, ast.Add)
    if not is_sum or len(node.targets) != 1:
        return None
    assert isinstance(value, ast.BinOp)
    return value.right if ast.unparse(value.left) == ast.unparse(node.targets[0]) else None
