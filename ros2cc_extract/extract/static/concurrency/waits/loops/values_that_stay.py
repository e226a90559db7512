"""
Writes after which a loop goes on: ``self.done = False`` does not end ``while not self.done``.

Of a loop's tests a small formula is kept: what it asks by name, constants, and how these are
joined. What else stands there is not known, and then a write may end the loop.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.loop_formulas import Formula, LoopTest
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.waits.loops.local_copies import without_copies
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_ends import evaluated, seen_by
from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import LEAVES, own_parts
from ros2cc_extract.extract.static.python.machine.dependences import constant_key
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.values.constant_folding import COMPARISONS
from ros2cc_extract.extract.static.python.values.containers import Mapping
from ros2cc_extract.extract.static.python.values.values import Const

_NAMED = (ast.Attribute, ast.Name, ast.Subscript)
_COMPARED = {**COMPARISONS, ast.Is: operator.is_, ast.IsNot: operator.is_not}


def tests_of(
    machine: ConcurrentMachine,
    loop: ast.While,
    tests: Sequence[ast.expr],
    shown: Sequence[ast.expr],
    frame: Frame,
) -> tuple[LoopTest, ...]:
    """
    What keeps a loop going.

    :param tests: those that may end it; ``shown`` are the same with data for local copies of it.
    """
    return tuple(
        LoopTest(_formula(machine, each, frame), stays_if=stays_if(test, loop))
        for test, each in zip(tests, shown, strict=True)
    )


def stays_if(test: ast.expr, loop: ast.While) -> bool | None:
    """How a test comes out where the loop goes on; ``None`` where it may leave it either way."""
    if test is loop.test:
        return True
    for part in own_parts(loop.body):
        if isinstance(part, ast.If) and part.test is test:
            leaves = [any(isinstance(e, LEAVES) for e in arm) for arm in (part.body, part.orelse)]
            return None if all(leaves) else not leaves[0]
    return None


def _formula(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> Formula:
    if isinstance(node, ast.Constant):
        return Formula('constant', value=node.value)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return Formula('not', (_formula(machine, node.operand, frame),))
    if isinstance(node, ast.BoolOp):
        parts = tuple(_formula(machine, each, frame) for each in node.values)
        return Formula('and' if isinstance(node.op, ast.And) else 'or', parts)
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        compared = _COMPARED.get(type(node.ops[0]))
        sides = tuple(_formula(machine, e, frame) for e in (node.left, node.comparators[0]))
        if compared is not None:
            return Formula('compared', sides, value=compared, node=node)
    called = getattr(node.func, 'id', '') if isinstance(node, ast.Call) else ''
    arguments = node.args if isinstance(node, ast.Call) else []
    if called == 'bool' and len(arguments) == 1:
        return _formula(machine, arguments[0], frame)
    of_all = arguments[0] if called in _OF_ALL and len(arguments) == 1 else None
    items = [] if of_all is None else _items(of_all) or _values_of(machine, of_all, frame)
    if items:
        return Formula(_OF_ALL[called], tuple(_formula(machine, e, frame) for e in items))
    names = seen_by(machine, [node], frame).names
    item = constant_key(node.slice) if isinstance(node, ast.Subscript) else None
    is_whole = not isinstance(node, ast.Subscript) or item is not None
    is_asked = isinstance(node, _NAMED) or called == 'getattr'
    if is_asked and len(names) == 1 and is_whole:
        return Formula('asked', name=min(names), item=item, node=node)
    return Formula('open', names=names, node=node)


_OF_ALL = {'all': 'and', 'any': 'or'}


def _items(node: ast.expr) -> list[ast.expr]:
    """What ``all`` and ``any`` go over, where it stands there: items, or one for each constant."""
    if isinstance(node, (ast.List, ast.Tuple)):
        return node.elts
    if not isinstance(node, (ast.GeneratorExp, ast.ListComp)) or len(node.generators) != 1:
        return []
    (generator,) = node.generators
    over, target = generator.iter, generator.target
    is_known = isinstance(over, (ast.List, ast.Tuple)) and isinstance(target, ast.Name)
    if not is_known or generator.ifs or generator.is_async:
        return []
    constants = [each for each in over.elts if isinstance(each, ast.Constant)]  # type: ignore[attr-defined]
    if len(constants) < len(over.elts):  # type: ignore[attr-defined]
        return []
    return [
        without_copies(node.elt, {target.id: each}, lambda value: True)  # type: ignore[attr-defined]
        for each in constants
    ]


def _values_of(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> list[ast.expr]:
    """``self.ready.values()``: an item for each key that the dictionary is known to have."""
    if isinstance(node, (ast.GeneratorExp, ast.ListComp)) and len(node.generators) == 1:
        (each,) = node.generators
        is_plain = not each.ifs and ast.dump(node.elt) == ast.dump(_as_read(each.target))
        return _values_of(machine, each.iter, frame) if is_plain else []
    asked = node.func if isinstance(node, ast.Call) else None
    if not isinstance(asked, ast.Attribute) or asked.attr != 'values':
        return []
    held = evaluated(machine, asked.value, frame)
    keys = list(held[0].entries) if len(held) == 1 and isinstance(held[0], Mapping) else []
    if not all(isinstance(key, Const) and isinstance(key.value, (str, int)) for key in keys):
        return []
    constants = [ast.Constant(key.value) for key in keys if isinstance(key, Const)]
    items = [ast.Subscript(asked.value, key, ast.Load()) for key in constants]
    return [ast.fix_missing_locations(ast.copy_location(item, node)) for item in items]


def _as_read(target: ast.expr) -> ast.expr:
    return ast.Name(target.id, ast.Load()) if isinstance(target, ast.Name) else target


def needed_of(
    machine: ConcurrentMachine, tests: Sequence[LoopTest], frame: Frame
) -> list[tuple[LoopTest, bool]]:
    """
    What must come out otherwise for the loop to end, if that is several, each by data of its own.

    What does so already, for good, is left out; and with each, whether it surely does not.
    """
    asking = [test for test in tests if test.formula.all_names]
    needed = asking[0].needed() if len(asking) == 1 else ()
    if len(needed) < 2 or not all(each.formula.all_names for each in needed):
        return []
    found = []
    for each in needed:
        node = each.formula.node
        options = evaluated(machine, node, frame) if node is not None else ()
        truths = {machine.truth(option) for option in options} or {None}
        if truths != {not each.stays_if}:
            found.append((each, truths == {each.stays_if}))
    return found
