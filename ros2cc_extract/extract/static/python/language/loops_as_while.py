"""
``for`` loops that are ``while True`` in other words.

``for _ in itertools.count():`` has a name that grows in each round;
``for item in iter(function, sentinel):`` takes ``item = function()`` in each round, and is left
where that is the sentinel. Source: CPython 3.12, library reference, "Built-in
Functions", ``iter``. ``for item in self.readings():`` takes the next reading in each round, and is
never left where the generator itself is ``while True``.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.builtins import generators
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import Bound, Function, Instance, Library

_ENDLESS = {'itertools.count': 2, 'itertools.repeat': 1}
"""What gives items forever, with at most so many arguments."""
_REPEATING = 'iter'


def as_while(machine: Machine, node: ast.For | ast.AsyncFor, frame: Frame) -> ast.While | None:
    """The ``while`` loop that does the same, if there is one."""
    items = node.iter
    if not isinstance(items, ast.Call) or not isinstance(node, ast.For):
        return None
    if _is_endless_generator(machine, items.func, frame):
        return noted_on(node, 'as_while', _taken)
    if not isinstance(node.target, ast.Name):
        return None
    if not isinstance(items.func, (ast.Name, ast.Attribute)) or items.keywords:
        return None
    name = items.func.id if isinstance(items.func, ast.Name) else items.func.attr
    if name == _REPEATING and isinstance(items.func, ast.Name):
        is_plain = len(items.args) == 2 and not any(isinstance(e, ast.Starred) for e in items.args)
        return noted_on(node, 'as_while', _repeated) if is_plain else None
    if not any(name == known.rpartition('.')[2] for known in _ENDLESS):
        return None
    called = machine.evaluate(items.func, frame)
    if not isinstance(called, Library) or len(items.args) > _ENDLESS.get(called.name, -1):
        return None
    loop = noted_on(node, 'as_while', _endless)
    machine.assign(node.target, machine.mystery('a counter', frame.place(node.iter)), frame)
    return loop


def asked_by_method(machine: Machine, node: ast.While, frame: Frame) -> ast.While:
    """``while gate:`` as ``while gate.__bool__():`` where a class of the program has that."""
    operands = [part for part in _operands(node.test) if isinstance(part, _NAMED)]
    asked = {id(each): name for each in operands if (name := _method_of(machine, each, frame))}
    if not asked:
        return node
    key = 'asked_by_' + '_'.join(asked.get(id(each), '') for each in operands)
    return noted_on(node, key, lambda node: _asked(node, asked))


_NAMED = (ast.Name, ast.Attribute)
_METHODS = ('__bool__', '__len__')


def _operands(test: ast.expr) -> list[ast.expr]:
    """What is asked for its truth: ``a`` and ``b`` in ``a and not b``."""
    if isinstance(test, ast.BoolOp):
        return [part for each in test.values for part in _operands(each)]
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        return _operands(test.operand)
    return [test]


def _method_of(machine: Machine, operand: ast.expr, frame: Frame) -> str | None:
    noted, machine.world.effects = machine.world.effects, None
    value, place = machine.evaluate(operand, frame), frame.place(operand)
    machine.world.effects = noted
    if not isinstance(value, Instance):
        return None
    return next((n for n in _METHODS if machine.special_method(value, n, place)), None)


def _asked(node: ast.While, asked: dict[int, str]) -> ast.While:
    def rewritten(test: ast.expr) -> ast.expr:
        if isinstance(test, ast.BoolOp):
            made: ast.expr = ast.BoolOp(test.op, [*map(rewritten, test.values)])
        elif isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            made = ast.UnaryOp(test.op, rewritten(test.operand))
        elif id(test) in asked:
            method = ast.Attribute(test, asked[id(test)], ast.Load())
            made = ast.Call(ast.copy_location(method, test), [], [])
        else:
            return test
        return ast.copy_location(made, test)

    return ast.copy_location(ast.While(rewritten(node.test), node.body, node.orelse), node)


def _is_endless_generator(machine: Machine, function: ast.expr, frame: Frame) -> bool:
    """Whether ``self.readings`` is a generator that gives items forever."""
    is_plain = isinstance(function, ast.Attribute) and isinstance(function.value, ast.Name)
    if not is_plain and not isinstance(function, ast.Name):
        return False
    noted, machine.world.effects = machine.world.effects, None
    called = machine.evaluate(function, frame)
    machine.world.effects = noted
    known = called.function if isinstance(called, Bound) else called
    return (
        isinstance(known, Function)
        and generators.is_generator(known)
        and noted_on(known.node, 'never_ends', _never_ends)
    )


def _never_ends(function: ast.AST) -> bool:
    """Whether the body comes to ``while True:`` with nothing that leaves it."""
    loops = (part for part in getattr(function, 'body', ()) if isinstance(part, ast.While))
    return any(
        isinstance(loop.test, ast.Constant)
        and bool(loop.test.value)
        and not any(isinstance(part, (*_LEAVES, ast.Raise)) for part in walk(loop))
        for loop in loops
    )


def _taken(node: ast.For) -> ast.While:
    item = ast.Call(ast.Name('next', ast.Load()), [node.iter], [])
    return _made(node, [ast.Assign([node.target], item)], node.orelse)


def counting(node: ast.For | ast.AsyncFor) -> ast.While | None:
    """
    The ``while`` that counts its rounds, for ``for _ in range(n):`` with a way out of it.

    It is there to be looked at; the ``for`` is what is run.
    """
    items, target = node.iter, node.target
    if not isinstance(node, ast.For) or not isinstance(items, ast.Call):
        return None
    is_counted = isinstance(items.func, ast.Name) and items.func.id == 'range' and items.args
    if not is_counted or not isinstance(target, ast.Name):
        return None
    return noted_on(node, 'counting', _counting)


def _counting(node: ast.For) -> ast.While | None:
    assert isinstance(node.target, ast.Name) and isinstance(node.iter, ast.Call)
    if not _looks_and_leaves(node):
        return None
    count = ast.Name(node.target.id, ast.Load())
    test = ast.Compare(count, [ast.Lt()], [node.iter.args[-1]])
    grows = ast.AugAssign(node.target, ast.Add(), ast.Constant(1))
    return _made(node, [grows], node.orelse, test)


def _looks_and_leaves(node: ast.For) -> bool:
    """Whether it is left by tests of data alone: what a call answers may be of another kind."""
    ifs = [part for part in walk(node) if isinstance(part, ast.If)]
    ways = [each for each in ifs if any(isinstance(part, _LEAVES) for part in each.body)]
    calls = (part for each in ways for part in walk(each.test) if isinstance(part, ast.Call))
    return bool(ways) and all(_name_of(call) in _PLAIN for call in calls)


_LEAVES = (ast.Break, ast.Return)
_PLAIN = frozenset(['len', 'bool', 'any', 'all', 'isinstance', 'abs', 'ok'])


def _name_of(call: ast.Call) -> str:
    function = call.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, 'id', '')


def _endless(node: ast.For) -> ast.While:
    assert isinstance(node.target, ast.Name)
    grows = ast.AugAssign(node.target, ast.Add(), ast.Constant(1))
    return _made(node, [grows], node.orelse)


def _repeated(node: ast.For) -> ast.While:
    assert isinstance(node.target, ast.Name) and isinstance(node.iter, ast.Call)
    function, sentinel = node.iter.args
    taken = ast.Assign([node.target], ast.Call(function, [], []))
    item = ast.Name(node.target.id, ast.Load())
    is_last = ast.Compare(item, [ast.Eq()], [sentinel])
    return _made(node, [taken, ast.If(is_last, [*node.orelse, ast.Break()], [])])


def _made(
    node: ast.For,
    first: list[ast.stmt],
    orelse: Sequence[ast.stmt] = (),
    test: ast.expr | None = None,
) -> ast.While:
    """A loop with the body of ``node``, and ``first`` in each round."""
    loop = ast.While(test or ast.Constant(True), [*first, *node.body], [*orelse])
    ast.copy_location(loop, node)
    known = set(map(id, ast.walk(node)))
    for part in (part for each in (loop.test, *first) for part in ast.walk(each)):
        if id(part) not in known:
            ast.copy_location(part, node.iter)
    return loop
