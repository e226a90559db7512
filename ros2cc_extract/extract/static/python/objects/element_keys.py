"""
Which item of a container is meant: ``self.counts['left']``, ``self.counts[name]``.

A name counts where it is a parameter that nothing stores to: a function that was made for one
item, or called with it, means that one in all its rounds. So does a constant of the module, which
is bound once in its file.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator, Sequence

from ros2cc_extract.extract.static.program.module_constants import module_constants
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.dependences import computed_from, constant_key
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer
from ros2cc_extract.extract.static.python.values.values import Const, Mystery, Scope, Value
from ros2cc_extract.spec.effects import BEGINS

_FORMATTED = re.compile(r"""f['"]([^'"{}\\…]+)""")
_Function = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda


def note_item(machine: Machine, container: ast.expr, key: ast.expr, frame: Frame) -> None:
    """``container[key]`` is asked for or stored."""
    if machine.world.effects is not None:
        item, sources = constant_key(key) or _beginning(key), computed_from(key, frame.sources)
        given = _given(machine, key, frame) if item is None else None
        if given is not None and (given.endswith(BEGINS) or not sources):
            item = given
        machine.world.reading.note_item(container, item, frame.place(container))
        machine.world.reading.note_choice(container, sources, frame.place(container))


def _given(machine: Machine, key: ast.expr, frame: Frame) -> str | None:
    """The text of what a parameter or constant was given, if that is one value in every run."""
    if not isinstance(key, ast.Name):
        return None
    held, item, trees = _held(key.id, frame), None, machine.world.trees
    if isinstance(held, Const) and type(held.value) in (str, int):
        item = repr(held.value)
    elif isinstance(held, Mystery):
        item = _beginning(held.node) or _beginning_in(held.text)
    if item is None:
        return None
    if _is_one_by_one(machine.world.current) and _is_among(key, trees, _kept_parameters):
        return item
    return item if _is_among(key, trees, module_constants) else None


def _beginning(key: ast.expr | None) -> str | None:
    """How a formatted text begins, if with letters of its own: ``f'left_{number}'``."""
    first = key.values[0] if isinstance(key, ast.JoinedStr) and key.values else None
    if not isinstance(first, ast.Constant) or not first.value:
        return None
    return f'{first.value!r}{BEGINS}'


def _beginning_in(text: str) -> str | None:
    """The same of the source of an expression, which may be shortened."""
    found = _FORMATTED.match(text)
    return f'{found[1]!r}{BEGINS}' if found else None


def _is_one_by_one(doer: object) -> bool:
    """Whether functions of one text that were given different values are kept apart there."""
    return isinstance(doer, Doer) and doer.has_own_text


def _held(name: str, frame: Frame) -> Value | None:
    scope: Scope | None = frame.scope
    while scope is not None:
        if name in scope.slots:
            value: Value = scope.slots[name]
            return value
        scope = scope.parent
    bound = frame.module.slots.get(name)
    return bound if isinstance(bound, Value) else None


def _is_among(
    key: ast.Name, trees: Sequence[ast.Module], uses: Callable[[ast.Module], frozenset[int]]
) -> bool:
    return any(id(key) in noted_on(tree, uses.__name__, uses) for tree in trees)


def _kept_parameters(tree: ast.Module) -> frozenset[int]:
    """The uses of parameters that nothing in their function stores to, by identity."""
    return frozenset(
        id(part)
        for function in walk(tree)
        if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda))
        for part in _uses_of_kept(function)
    )


def _uses_of_kept(function: _Function) -> Iterator[ast.Name]:
    given = (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)
    names = [part for part in walk(function) if isinstance(part, ast.Name)]
    stored = {part.id for part in names if not isinstance(part.ctx, ast.Load)}
    kept = {each.arg for each in given} - stored
    yield from (part for part in names if part.id in kept)
