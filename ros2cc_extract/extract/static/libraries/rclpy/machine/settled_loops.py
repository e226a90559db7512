"""
Loops that have ended for good before a callback may begin.

``while self.seen < 1: rclpy.spin_once(self)`` stands in a method, and only behind it that method
makes the callback, or one that makes it. As ``seen`` only grows, the callback never enters the
loop when it comes to the method again.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.values.values import Bound, Class, Instance
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_Method = ast.FunctionDef | ast.AsyncFunctionDef
_METHODS = (ast.FunctionDef, ast.AsyncFunctionDef)


@dataclass(frozen=True)
class _Loop:
    file: str
    method: _Method
    loop: ast.While


def is_over_before(world: RosWorld, loop: ast.While, file: str) -> bool:
    """Whether the running callback begins only when a loop of its object is over for good."""
    entity = world.current
    if not isinstance(entity, EntityState):
        return False
    found = _method_of(entity, loop, file)
    return (
        found is not None
        and _stays_over(loop, found.method, world)
        and _is_made_behind(entity, found, world)
    )


def _receiver(entity: EntityState) -> Instance | None:
    bound = entity.callback
    is_method = isinstance(bound, Bound) and isinstance(bound.receiver, Instance)
    return bound.receiver if is_method else None  # type: ignore[union-attr]


def _method_of(entity: EntityState, loop: ast.While, file: str) -> _Loop | None:
    receiver = _receiver(entity)
    for cls in receiver.mro if receiver is not None else ():
        if isinstance(cls, Class) and cls.module.file == file:
            for method in cls.node.body:
                if isinstance(method, _METHODS) and any(each is loop for each in method.body):
                    return _Loop(file, method, loop)
    return None


def _is_made_behind(
    entity: EntityState, found: _Loop, world: RosWorld, seen: tuple[EntityState, ...] = ()
) -> bool:
    """Whether the method of the loop makes a callback, or one that it has made there does."""
    if entity in seen or not isinstance(entity.callback, Bound):
        return False
    if _is_behind(entity.place, found) and _only_of_self(entity.callback.function.name, found):
        return True
    maker = entity.maker
    if not isinstance(maker, EntityState) or not isinstance(maker.callback, Bound):
        return False
    # Whoever calls the maker makes the callback too.
    is_ours = _receiver(maker) is _receiver(entity)
    if not is_ours or _is_called(maker.callback.function.name, world):
        return False
    runs_it = [each for each in world.entities if _runs(each, maker.callback)]
    return all(_is_made_behind(each, found, world, (*seen, entity)) for each in runs_it)


def _runs(entity: EntityState, bound: Bound) -> bool:
    return isinstance(entity.callback, Bound) and entity.callback.function is bound.function


def _is_behind(place: Place, found: _Loop) -> bool:
    end = found.loop.end_lineno or found.loop.lineno
    return place.file == found.file and end < place.line <= (found.method.end_lineno or 0)


def _only_of_self(name: str, found: _Loop) -> bool:
    """Whether the method names that function as its own object's."""
    named = [
        part.value
        for part in walk(found.method)
        if isinstance(part, ast.Attribute) and part.attr == name
    ]
    own = _self_of(found.method)
    return bool(named) and all(isinstance(v, ast.Name) and v.id == own for v in named)


def _self_of(method: _Method) -> str:
    return method.args.args[0].arg if method.args.args else ''


def _is_called(name: str, world: RosWorld) -> bool:
    return any(name in noted_on(tree, 'called_attributes', _called) for tree in world.trees)


def _called(tree: ast.AST) -> frozenset[str]:
    calls = (part.func for part in walk(tree) if isinstance(part, ast.Call))
    return frozenset(each.attr for each in calls if isinstance(each, ast.Attribute))


def _stays_over(loop: ast.While, method: _Method, world: RosWorld) -> bool:
    """Whether its test, once it has failed, fails ever after, and nothing else ends the loop."""
    if loop.orelse or any(isinstance(part, ast.Break) for part in walk(loop)):
        return False
    test = loop.test
    parts = (
        test.values if isinstance(test, ast.BoolOp) and isinstance(test.op, ast.And) else [test]
    )
    # When rclpy is shut down no callback begins.
    asked = [part for part in parts if ast.unparse(part) not in ('rclpy.ok()', 'ok()')]
    if len(asked) != 1:
        return False
    name, kind = _asks(asked[0], _self_of(method))
    first = loop.lineno if method.name == '__init__' else None
    stores = [s for tree in world.trees for s in _stores(tree, name, first)] if name else []
    return bool(stores) and all(_keeps(store, kind, world) for store in stores)


_FALSE, _NONE, _LESS = 'false', 'none', 'less'


def _asks(test: ast.expr, own: str) -> tuple[str, str]:
    """Which attribute a test asks for, and what it is as long as the loop goes on."""
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        return _attribute(test.operand, own), _FALSE
    if isinstance(test, ast.Compare) and len(test.ops) == 1:
        limit, asks = test.comparators[0], test.ops[0]
        if isinstance(limit, ast.Constant):
            if limit.value is None and isinstance(asks, ast.Is):
                return _attribute(test.left, own), _NONE
            is_number = isinstance(limit.value, (int, float))
            if is_number and isinstance(asks, (ast.Lt, ast.LtE)):
                return _attribute(test.left, own), _LESS
    return '', ''


def _attribute(node: ast.expr, own: str) -> str:
    is_own = isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)
    return node.attr if is_own and node.value.id == own else ''  # type: ignore[attr-defined]


@dataclass(frozen=True)
class _Store:
    """A statement that stores an attribute, and the function that it stands in."""

    statement: ast.AST
    function: _Method | None


def _stores(tree: ast.AST, name: str, first: int | None) -> Iterator[_Store]:
    """
    Statements that store it, but for the set-up of an object.

    :param first: in the set-up, only those before this line are left out.
    """
    for function, part in noted_on(tree, 'parts_by_function', _parts_by_function):
        if isinstance(part, ast.Attribute) and part.attr == name:
            is_set_up = function is not None and function.name == '__init__'
            if not (is_set_up and (first is None or part.lineno < first)):
                yield _Store(_statement(function or tree, part), function)


def _parts_by_function(tree: ast.AST) -> list[tuple[_Method | None, ast.AST]]:
    found: dict[int, tuple[_Method | None, ast.AST]] = {}
    parts = list(walk(tree))
    for holder in [None, *(part for part in parts if isinstance(part, _METHODS))]:
        for part in parts if holder is None else walk(holder):
            if isinstance(part, ast.Attribute) and not isinstance(part.ctx, ast.Load):
                found[id(part)] = (holder, part)
    return list(found.values())


def _statement(within: ast.AST, target: ast.AST) -> ast.AST:
    kinds = (ast.Assign, ast.AugAssign, ast.AnnAssign)
    statements = (part for part in walk(within) if isinstance(part, kinds))
    return next((s for s in statements if any(p is target for p in _targets(s))), target)


def _targets(statement: ast.Assign | ast.AugAssign | ast.AnnAssign) -> Sequence[ast.expr]:
    return statement.targets if isinstance(statement, ast.Assign) else [statement.target]


def _keeps(store: _Store, kind: str, world: RosWorld) -> bool:
    """Whether the loop is over behind a store, and stays so where it was over before."""
    statement = store.statement
    if isinstance(statement, ast.AugAssign):
        grows = isinstance(statement.op, ast.Add) and _is_positive(statement.value)
        return kind == _LESS and grows
    if kind == _LESS or not isinstance(statement, (ast.Assign, ast.AnnAssign)):
        return False
    value = statement.value
    if isinstance(value, ast.Constant):
        return bool(value.value) if kind == _FALSE else value.value is not None
    return kind == _NONE and isinstance(value, ast.Name) and _is_given(value.id, store, world)


def _is_positive(value: ast.expr) -> bool:
    is_number = isinstance(value, ast.Constant) and isinstance(value.value, (int, float))
    return is_number and value.value > 0  # type: ignore[attr-defined]


def _is_given(name: str, store: _Store, world: RosWorld) -> bool:
    """Whether rclpy gives it to a callback that nobody else calls."""
    function = store.function
    if function is None or _is_called(function.name, world):
        return False
    given = function.args.args[1:]
    return not function.args.defaults and [each.arg for each in given] == [name]
