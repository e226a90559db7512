"""
Several ``if`` of one run of a function that ask the same.

What stands in an arm of the one and what stands in the opposite arm of the other exclude each
other just as the two arms of one statement do.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence

from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import options_of
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import When


def first_place(machine: Machine, node: ast.If, frame: Frame) -> tuple[Place, bool]:
    """
    Where this run has asked the same for the first time, and whether it asked the opposite.

    Only of the set-up: code that runs again, as a callback does, may take another arm each time.
    """
    place = frame.place(node)
    test, is_negated = _without_not(node.test)
    if machine.world.when is not When.START or not _is_plain(test):
        return place, False
    key = ast.dump(test)
    asked = tuple(tuple(options_of(machine.evaluate(part, frame))) for part in _parts(test))
    known = frame.tests.get(key)
    on_path = {step for step, _ in machine.world.path}
    if known is None or known[2] != asked or known[0] in on_path:
        frame.tests[key] = (place, is_negated, asked)
        return place, False
    return known[0], known[1] != is_negated


_OPPOSITE: dict[type[ast.cmpop], type[ast.cmpop]] = {ast.IsNot: ast.Is, ast.NotEq: ast.Eq}


def _without_not(test: ast.expr) -> tuple[ast.expr, bool]:
    """The test with ``not``, ``is not`` and ``!=`` taken away, and whether that turns it round."""
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner, is_negated = _without_not(test.operand)
        return inner, not is_negated
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        opposite = _OPPOSITE.get(type(test.ops[0]))
        if opposite is not None:
            return ast.Compare(test.left, [opposite()], test.comparators), True
    return test, False


def _is_plain(test: ast.expr) -> bool:
    """Whether nothing but names, attributes and constants is in it: asking changes nothing."""
    return all(_is_read(part) for part in _parts(test))


def _parts(test: ast.expr) -> Sequence[ast.expr]:
    return (test.left, *test.comparators) if isinstance(test, ast.Compare) else (test,)


def _is_read(part: ast.expr) -> bool:
    while isinstance(part, ast.Attribute):
        part = part.value
    return isinstance(part, (ast.Name, ast.Constant))
