"""
Variables of a function that functions inside of it share: flags, lists and dictionaries.

``done = False`` or ``state = {'done': False}`` in ``main``, which callbacks defined in it read and
change, is data like an attribute. What a callback makes anew in each run is its own, but the
done-callbacks that it defines write it too.
"""

from __future__ import annotations

import ast
from collections import Counter

from ros2cc_extract.extract.static.concurrency.machine.state import Cell, ConcurrentWorld
from ros2cc_extract.extract.static.program.text_queries import (
    changed_in_place,
    noted_on,
    walk,
)
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Class,
    Function,
    FunctionNode,
    Instance,
    Library,
    Module,
    Native,
    Scope,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import When

_INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
_CODE = (Bound, Class, Function, Library, Module, Native)


def owner_of(name: str, frame: Frame) -> Scope | None:
    """The function whose variable the name means."""
    scope: Scope | None = frame.scope
    while scope is not None:
        if name in scope.slots and name not in scope.global_names:
            return scope
        scope = scope.parent
    return None


def shown_cell(world: ConcurrentWorld, scope: Scope, name: str) -> str | None:
    """What the variable is called; ``None`` where functions inside do not share it as data."""
    function = scope.function
    if function is None or name not in noted_on(function.node, 'cells', _shared):
        return None
    if not _is_data(scope.slots.get(name)):
        return None
    shown = f'{function.qualname}{_number(world, scope)}.{name}'
    world.cells[shown] = Cell(scope, name)
    return shown


def is_own_name(name: str, frame: Frame) -> bool:
    """Whether a name is a variable of the running function alone, which none inside shares."""
    function = frame.function
    return (
        function is not None
        and owner_of(name, frame) is frame.scope
        and name not in noted_on(function.node, 'cells', _shared)
    )


def _number(world: ConcurrentWorld, scope: Scope) -> str:
    """Two calls of one function by the set-up have variables of their own."""
    assert scope.function is not None
    if scope.born is not None or world.second_pass:
        return ''
    known = world.cell_scopes.setdefault(id(scope.function.node), [])
    if scope not in known and world.when is not When.START:
        return ''
    if scope not in known:
        known.append(scope)
    number = known.index(scope) + 1
    return '' if number == 1 else f'#{number}'


def _is_data(held: object) -> bool:
    """Functions, entities and locks are no data that code shares."""
    options = [o for o in options_of(held) if o != NONE] if isinstance(held, Value) else []
    return not options or not all(
        isinstance(option, _CODE) or (isinstance(option, Instance) and option.state is not None)
        for option in options
    )


def _shared(node: FunctionNode) -> frozenset[str]:
    """
    The variables of a function that functions inside use, and that change.

    One that the function itself stores more than once changes too.
    """
    inside = {
        part
        for function in walk(node)
        if function is not node and isinstance(function, _INNER)
        for part in walk(function)
    }
    used = {part.id for part in inside if isinstance(part, ast.Name)}
    parts = list(walk(node))
    changed = {name for part in parts for name in changed_in_place(part)}
    changed |= {n for part in inside if isinstance(part, ast.Nonlocal) for n in part.names}
    stored = Counter(
        part.id
        for part in parts
        if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store) and part not in inside
    )
    return frozenset(used & (changed | {name for name, times in stored.items() if times > 1}))


def why_written_elsewhere(world: ConcurrentWorld, names: frozenset[str]) -> Unknown | None:
    """Why code that is not followed may write one of the variables."""
    for name in sorted(names):
        cell = world.cells.get(name)
        if cell is None or cell.scope.function is None:
            continue
        held = cell.scope.slots.get(cell.name, NONE)
        given = [world.handed_over.get(o) for o in options_of(held) if isinstance(o, Collection)]
        why = next((each for each in given if each is not None), None)
        why = why or _uncalled(world, cell.scope.function, cell.name)
        if why is not None:
            return why
    return None


def _uncalled(world: ConcurrentWorld, owner: Function, name: str) -> Unknown | None:
    """A function inside that writes the variable, and that no known code calls."""
    for function in walk(owner.node):
        if not isinstance(function, _INNER) or id(function) in world.called:
            continue
        if name in _written_in(function):
            called = 'a lambda' if isinstance(function, ast.Lambda) else function.name
            at = Place(owner.place.file, function.lineno, function.col_offset + 1)
            return Unknown(f'no known code calls {called}, which ends it', at)
    return None


def _written_in(function: FunctionNode) -> set[str]:
    parts = list(walk(function))
    named = {name for p in parts if isinstance(p, ast.Nonlocal) for name in p.names}
    return named | {name for part in parts for name in changed_in_place(part)}
