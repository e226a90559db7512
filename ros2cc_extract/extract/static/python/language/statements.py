"""
Running statements.

``execute_block`` returns how the block may end, as a sum of the constants of ``block_exits.py``;
more than one bit is set where that depends on a branch that cannot be decided.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from functools import reduce
from operator import or_
from typing import Any

from ros2cc_extract.extract.static.program.text_queries import noted_on
from ros2cc_extract.extract.static.python.branching import (
    open_tests,
)
from ros2cc_extract.extract.static.python.branching.order_of_text import stored_after
from ros2cc_extract.extract.static.python.builtins import code_behind
from ros2cc_extract.extract.static.python.language.control_flow import (
    run_for,
    run_if,
    run_match,
    run_while,
)
from ros2cc_extract.extract.static.python.language.kept_generators import kept
from ros2cc_extract.extract.static.python.language.try_blocks import (
    is_lack_uncaught,
    run_try,
)
from ros2cc_extract.extract.static.python.language.with_blocks import run_with
from ros2cc_extract.extract.static.python.machine import path_facts
from ros2cc_extract.extract.static.python.machine.block_exits import (
    BREAK,
    CONTINUE,
    DEAD,
    LEAVING,
    NEXT,
    RETURN,
)
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine, held_by_all
from ros2cc_extract.extract.static.python.machine.store import Writes
from ros2cc_extract.extract.static.python.machine.world import (
    AccessKind,
)
from ros2cc_extract.extract.static.python.objects import memoization
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.containers import Sequence as Items
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Library,
    Module,
    Mystery,
    Native,
    Partial,
    Scope,
    Value,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import TAKES, TAKES_ANY


class Statements(Machine):
    """The statements of the language."""

    def execute_block(self, body: Sequence[ast.stmt], frame: Frame) -> int:
        """Run ``body`` in order; what follows a possible early exit is conditional."""
        path, exits = self.world.path, 0
        reading, passed = self.world.reading, self.world.reading.passed
        try:
            for statement in body:
                flow = self.execute(statement, frame)
                exits |= flow & ~NEXT
                if not flow & NEXT:
                    return exits
                if flow & LEAVING and frame.function is not None:
                    self.world.path = (*self.world.path, (frame.place(statement), -1))
                if isinstance(statement, ast.Assert) or _may_raise(statement):
                    reading.passed = (*reading.passed, (frame.place(statement), -1))
            return exits | NEXT
        finally:
            self.world.path, reading.passed = path, passed

    def execute(self, statement: ast.stmt, frame: Frame) -> int:
        """Run one statement."""
        self.charge(1)
        handler, effects = _STATEMENTS.get(type(statement)), self.world.effects
        frame.statement = statement
        flow = handler(self, statement, frame) if handler else NEXT
        if self.world.stopped:
            self.world.effects = effects
            return DEAD
        return flow

    def branches(
        self,
        bodies: Sequence[Callable[[], int]],
        place: Place,
        frame: Frame,
    ) -> int:
        """Run alternatives from one state; joins what may hold after them."""
        ends: list[tuple[int, Writes]] = []
        held, kept = self.world.held, []
        ready, known = self.world.ready, []
        for index, body in enumerate(bodies):
            self.world.held, self.world.ready = held, ready
            with self.on_path(place, index):
                mark = self.store.open_branch()
                flow = body()
                if self.world.stopped:
                    flow, self.world.stopped = DEAD, False
                ends.append((flow, self.store.close_branch(mark)))
                if flow & NEXT:
                    kept.append(self.world.held)
                    known.append(self.world.ready)
        self.world.held = held_by_all(kept or [held])
        self.world.ready = path_facts.of_all(known or [ready])
        live = [end for end in ends if end[0] & ~DEAD]
        if not live:
            self.store.join([writes for _, writes in ends])
            return DEAD
        _keep_loop_exits(live, frame)
        going = [writes for flow, writes in live if flow & NEXT]
        leaving = [_without(writes, frame.scope) for flow, writes in live if not flow & NEXT]
        if going:
            self.store.join(going, leaving)
        else:
            self.store.join([writes for _, writes in live])
        return reduce(or_, (flow for flow, _ in live)) & ~DEAD


def _keep_loop_exits(ends: Sequence[tuple[int, Writes]], frame: Frame) -> None:
    """What a branch wrote to own names before ``break`` or ``continue`` holds later on."""
    for flow, writes in ends:
        own = {key: entry for key, entry in writes.items() if entry[0] is frame.scope}
        if own and flow & BREAK:
            frame.breaks.append(own)
        if own and flow & CONTINUE:
            frame.continues.append(own)


def _without(writes: Writes, scope: Scope) -> Writes:
    """The writes of a branch that leaves the function, less those to its own names."""
    return {key: entry for key, entry in writes.items() if entry[0] is not scope}


def _expression(machine: Statements, node: ast.Expr, frame: Frame) -> int:
    if _is_of_own_name(node.value, frame):
        value = machine.evaluate(node.value, frame)
    else:
        with machine.world.reading.apart():
            value = machine.evaluate(node.value, frame)
    if isinstance(node.value, ast.Call):
        machine.note_discarded(value, frame.place(node.value))
    return NEXT


def _is_of_own_name(value: ast.expr, frame: Frame) -> bool:
    """``rows.append(x)``: what is put into an object of the function's own may be given back."""
    while isinstance(value, (ast.Attribute, ast.Subscript, ast.Call, ast.Await)):
        value = value.func if isinstance(value, ast.Call) else value.value
    return not isinstance(value, ast.Name) or (
        value.id != 'self' and value.id in frame.scope.slots
    )


def _assign(machine: Statements, node: ast.Assign, frame: Frame) -> int:
    if all(isinstance(target, ast.Attribute) for target in node.targets):
        with machine.world.reading.apart():
            return _assign_to(machine, node, frame)
    return _assign_to(machine, node, frame)


def _assign_to(machine: Statements, node: ast.Assign, frame: Frame) -> int:
    _note_literal(machine, node.value, node.targets, frame)
    behind = machine.last_wait()
    value = kept(machine, node.value, frame) or open_tests.evaluate_copied(
        machine, node.value, node.targets, frame
    )
    with machine.in_one_piece(node, frame), stored_after(machine, behind, node.value, frame):
        for target in node.targets:
            machine.assign(target, value, frame)
    machine.world.reading.flowing = frozenset()
    return NEXT


def _note_literal(
    machine: Statements, value: ast.expr, targets: Sequence[ast.expr], frame: Frame
) -> None:
    if isinstance(value, ast.Constant) and machine.world.effects is not None:
        machine.world.literals.update((frame.place(target), value.value) for target in targets)


def _assign_annotated(machine: Statements, node: ast.AnnAssign, frame: Frame) -> int:
    if node.value is not None:
        _note_literal(machine, node.value, [node.target], frame)
        behind = machine.last_wait()
        value = kept(machine, node.value, frame) or open_tests.evaluate_copied(
            machine, node.value, [node.target], frame
        )
        with stored_after(machine, behind, node.value, frame):
            machine.assign(node.target, value, frame)
        machine.world.reading.flowing = frozenset()
    return NEXT


def _assign_augmented(machine: Statements, node: ast.AugAssign, frame: Frame) -> int:
    target = node.target
    load = ast.copy_location(_as_load(target), target)
    if isinstance(target, ast.Attribute) and code_behind.is_assigned_by_call(
        machine, target, frame
    ):
        return _assign(machine, noted_on(node, 'as_assignment', _as_assignment), frame)
    noted, machine.world.effects = machine.world.effects, None
    old = machine.evaluate(load, frame)
    machine.world.effects = noted
    behind = machine.last_wait()
    value = machine.evaluate(node.value, frame)
    waited = stored_after(machine, behind, node.value, frame)
    with machine.in_one_piece(node, frame), waited:
        machine.note_update(load, frame, AccessKind.UPDATE)
        machine.note_part(load, frame)
    if isinstance(old, Collection) and isinstance(node.op, _IN_PLACE):
        machine.note_update(load, frame, AccessKind.UPDATE_IN_PLACE)
    if isinstance(old, Items) and old.kind == 'list' and isinstance(node.op, ast.Add):
        items, rest = machine.items_of(value, frame.place(node))
        machine.charge(len(items))
        machine.store.write(old, 'items', (*old.items, *items))
        machine.store.write(old, 'open', old.others or rest)
        return NEXT
    new = machine.operate(node.op, old, value, frame, node)
    machine.world.effects = None
    machine.assign(target, new, frame)
    machine.world.effects = noted
    return NEXT


_IN_PLACE = (ast.BitOr, ast.BitAnd, ast.BitXor, ast.Sub)


def _as_assignment(node: ast.AugAssign) -> ast.Assign:
    """``x.level += 1`` where code stands behind ``x.level``: that is asked, and then called."""
    old = ast.copy_location(_as_load(node.target), node.target)
    new = ast.copy_location(ast.BinOp(old, node.op, node.value), node.value)
    return ast.copy_location(ast.Assign([node.target], new), node)


def _as_load(target: ast.Name | ast.Attribute | ast.Subscript) -> ast.expr:
    if isinstance(target, ast.Name):
        return ast.Name(target.id, ast.Load())
    if isinstance(target, ast.Attribute):
        return ast.Attribute(target.value, target.attr, ast.Load())
    return ast.Subscript(target.value, target.slice, ast.Load())


def _return(machine: Statements, node: ast.Return, frame: Frame) -> int:
    found = set[str]()
    with machine.world.reading.of(found):
        frame.results.append(machine.evaluate(node.value, frame) if node.value else NONE)
    machine.note_return(node, frame, found)
    frame.known_at_return.append(machine.world.ready)
    return RETURN


def _may_raise(statement: ast.stmt) -> bool:
    """A test that turns away by an exception; what follows is done where it does not."""
    if not isinstance(statement, ast.If) or statement.orelse:
        return False
    return isinstance(statement.body[-1], ast.Raise)


def _raise(machine: Statements, node: ast.Raise, frame: Frame) -> int:
    if node.exc is not None:
        machine.evaluate(node.exc, frame)
        machine.note_raised(node.exc, frame.place(node))
    return DEAD


def _break(machine: Statements, node: ast.Break, frame: Frame) -> int:
    frame.known_at_break.append(machine.world.ready)
    return BREAK


def _function(
    machine: Statements, node: ast.FunctionDef | ast.AsyncFunctionDef, frame: Frame
) -> int:
    machine.assign(ast.Name(node.name, ast.Store()), machine.make_function(node, frame), frame)
    return NEXT


def _class(machine: Statements, node: ast.ClassDef, frame: Frame) -> int:
    value: Value = machine.make_class(node, frame)
    for decorator in reversed(node.decorator_list):
        wrapper = machine.evaluate(decorator, frame)
        if isinstance(value, Class):
            machine.world.decorated_classes.append(value)
        if isinstance(wrapper, (Function, Bound, Partial, Class, Instance, Native)):
            result = machine.call(wrapper, Call(frame.place(decorator), [value]))
            value = value if isinstance(result, Mystery) else result
        elif isinstance(value, Class):
            memoization.doubt(machine.world, value, 'is decorated by', decorator)
    machine.assign(ast.Name(node.name, ast.Store()), value, frame)
    return NEXT


def _import(machine: Statements, node: ast.Import, frame: Frame) -> int:
    for alias in node.names:
        module = machine.import_module(alias.name, frame.place(node))
        _note_import(machine, module)
        if alias.asname is None:
            top = alias.name.partition('.')[0]
            module = machine.import_module(top, frame.place(node))
        name = alias.asname or alias.name.partition('.')[0]
        machine.assign(ast.Name(name, ast.Store()), module, frame)
    return NEXT


def _import_from(machine: Statements, node: ast.ImportFrom, frame: Frame) -> int:
    place = frame.place(node)
    name = absolute_name(node, frame.module)
    module = machine.import_module(name, place)
    for alias in node.names:
        if alias.name == '*':
            _import_star(machine, module, frame)
            continue
        value = machine.imported(module, name, alias.name, place)
        _note_import(machine, value)
        machine.assign(ast.Name(alias.asname or alias.name, ast.Store()), value, frame)
    return NEXT


_IMPORT_ERRORS = frozenset({'ImportError', 'ModuleNotFoundError', 'Exception', 'BaseException'})


def _note_import(machine: Statements, value: Value) -> None:
    """Whether the program goes on without a part of a library that is not there."""
    if isinstance(value, Library):
        known = machine.world.caught_imports
        is_caught = any(not _IMPORT_ERRORS.isdisjoint(names) for names in machine.world.caught)
        known[value.name] = known.get(value.name, True) and is_caught


def _import_star(machine: Statements, module: Value, frame: Frame) -> None:
    if isinstance(module, Module):
        for name, value in list(module.slots.items()):
            if isinstance(name, str) and not name.startswith('_'):
                machine.assign(ast.Name(name, ast.Store()), value, frame)
        frame.module.stars.extend(module.stars)
    else:
        frame.module.stars.append(module)


def absolute_name(node: ast.ImportFrom, module: Module) -> str:
    """Dotted name of the module that a ``from`` import names."""
    if not node.level:
        return node.module or ''
    parts = module.package.split('.') if module.package else []
    kept = parts[: len(parts) - (node.level - 1)] if node.level > 1 else parts
    return '.'.join([*kept, *([node.module] if node.module else [])])


def _global(machine: Statements, node: ast.Global, frame: Frame) -> int:
    frame.scope.global_names.update(node.names)
    return NEXT


def _nonlocal(machine: Statements, node: ast.Nonlocal, frame: Frame) -> int:
    frame.scope.nonlocal_names.update(node.names)
    return NEXT


def _delete(machine: Statements, node: ast.Delete, frame: Frame) -> int:
    """``del name`` and ``del object.attribute``; items stay."""
    for target in node.targets:
        if isinstance(target, ast.Name):
            machine.store.remove(frame.scope, target.id)
        elif isinstance(target, ast.Subscript):
            _delete_item(machine, target, frame)
        elif isinstance(target, ast.Attribute):
            code_behind.delete(machine, target, frame)
    return NEXT


def _delete_item(machine: Statements, target: ast.Subscript, frame: Frame) -> None:
    noted, machine.world.effects = machine.world.effects, None
    owner, place = machine.evaluate(target.value, frame), frame.place(target)
    machine.world.effects = noted
    method = machine.special_method(owner, '__delitem__', place)
    if method is None:
        is_certain = isinstance(target.slice, ast.Constant) and is_lack_uncaught(machine)
        machine.world.moves = TAKES_ANY if is_certain else TAKES
        machine.note_update(target, frame, AccessKind.UPDATE_IN_PLACE)
        machine.world.moves = None
    else:
        machine.call(method, Call(place, [machine.evaluate(target.slice, frame)]))


def _constant_flow(flow: int) -> Callable[..., int]:
    return lambda machine, node, frame: flow


def _assert(machine: Statements, node: ast.Assert, frame: Frame) -> int:
    open_tests.decide_assertion(machine, node, frame)
    return NEXT


_STATEMENTS: dict[type[ast.stmt], Callable[..., Any]] = {
    ast.Expr: _expression,
    ast.Assign: _assign,
    ast.AnnAssign: _assign_annotated,
    ast.AugAssign: _assign_augmented,
    ast.Return: _return,
    ast.Raise: _raise,
    ast.If: run_if,
    ast.Try: run_try,
    ast.With: run_with,
    ast.AsyncWith: run_with,
    ast.Match: run_match,
    ast.For: run_for,
    ast.AsyncFor: run_for,
    ast.While: run_while,
    ast.FunctionDef: _function,
    ast.AsyncFunctionDef: _function,
    ast.ClassDef: _class,
    ast.Import: _import,
    ast.ImportFrom: _import_from,
    ast.Global: _global,
    ast.Nonlocal: _nonlocal,
    ast.Break: _break,
    ast.Continue: _constant_flow(CONTINUE),
    ast.Assert: _assert,
    ast.Delete: _delete,
}

if hasattr(ast, 'TryStar'):
    _STATEMENTS[ast.TryStar] = run_try
