"""
Attributes that an object surely lacks: no text of the program stores anything under that name.

``hasattr(self, '__x')`` asks for another name than ``self.__x`` stores, as a text is not mangled;
``self.lift`` of a class that has no ``lift`` raises ``AttributeError``. Only a program that is run
from an entry is whole; and where an attribute may come by a computed name, by ``__getattr__``, by
a base, a decorator or code that is not scanned, nothing is sure.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.program.text_queries import mangled, noted_on
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.machine.world import Cut, note_once
from ros2cc_extract.extract.static.python.values.values import Class, Instance, Library, Value
from ros2cc_extract.light_dataclasses import dataclass

_ASKING = frozenset({'hasattr', 'getattr', 'delattr'})
_COMPUTING = frozenset(
    {
        *('exec', 'eval', 'vars', 'setattr', '__dict__', '__setattr__', '__setstate__'),
        *('__getattr__', '__getattribute__'),
    }
)
"""What may store an attribute under a name that the text does not show."""


@dataclass(frozen=True)
class _Text:
    """
    What a text says about attributes.

    :param names: under which something may be stored, or that are known as a text.
    :param is_open: something may be stored under other names too.
    """

    names: frozenset[str]
    is_open: bool


def is_absent(machine: Machine, owner: Value, name: str) -> bool:
    """Whether ``owner`` has no attribute ``name`` at any time."""
    world = machine.world
    if not isinstance(owner, Instance) or not isinstance(owner.cls, Class):
        return False
    if not world.is_program or id(owner) in world.seen_outside or name in owner.slots:
        return False
    if not all(_lacks(machine, cls, name) for cls in owner.mro):
        return False
    texts = (noted_on(tree, 'attributes', _text_of) for tree in world.trees)
    return not any(text.is_open or name in text.names for text in texts)


def note_use(machine: Machine, owner: Value, node: ast.Attribute, frame: Frame) -> None:
    """
    ``owner.x`` is asked for: where that is absent, the statement raises and does nothing more.

    What the rest of the statement would do is noted nowhere, until ``execute`` goes on.
    """
    statement, world = frame.statement, machine.world
    if statement is None or not world.in_callback:
        return
    if id(node) not in noted_on(statement, 'sure_parts', _sure_parts):
        return
    name, place = frame.attribute_name(node.attr), frame.place(node)
    if not is_absent(machine, owner, name):
        return
    machine.note_raised(ast.Name('AttributeError', ast.Load()), place)
    if not world.caught:
        reason = f'{node.attr!r} is assigned nowhere, so that this raises AttributeError'
        note_once(world.cut, Cut(reason, place, machine.running_classes()))
    world.effects, world.stopped = EffectLog(), True


def _sure_parts(statement: ast.stmt) -> frozenset[int]:
    """The attributes that are asked for whenever the statement begins."""
    found, waiting = set[int](), list[ast.AST]()
    if isinstance(statement, (ast.Expr, ast.Assign, ast.AnnAssign, ast.AugAssign, ast.Return)):
        waiting += [statement.value] if statement.value is not None else []
    elif isinstance(statement, ast.If):
        waiting.append(statement.test)
    while waiting:
        part = waiting.pop()
        if isinstance(part, ast.Attribute):
            found.add(id(part))
        if isinstance(part, ast.BoolOp):
            waiting.append(part.values[0])
        elif isinstance(part, ast.IfExp):
            waiting.append(part.test)
        elif isinstance(part, ast.Compare):
            waiting += [part.left, part.comparators[0]]
        elif not isinstance(part, _LATER):
            waiting += ast.iter_child_nodes(part)
    return frozenset(found)


_LATER = (ast.Lambda, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)


def _lacks(machine: Machine, cls: Value, name: str) -> bool:
    if isinstance(cls, Class):
        is_changed = cls.metaclass is not None or bool(cls.node.decorator_list)
        return not is_changed and not cls.node.keywords and name not in cls.slots
    if not isinstance(cls, Library):
        return False
    if cls.name == 'builtins.object':
        return not hasattr(object, name)
    rows = machine.model.rows(cls.name)
    return bool(rows) and all(row.has is not None and not row.has(name) for row in rows)


def _text_of(tree: ast.Module) -> _Text:
    names, is_open = set[str](), False
    for part, cls in _parts(tree, None):
        if isinstance(part, ast.Attribute):
            is_open = is_open or part.attr in _COMPUTING
            if not isinstance(part.ctx, ast.Load):
                names.add(mangled(part.attr, cls))
        elif isinstance(part, ast.Name):
            is_open = is_open or part.id in _COMPUTING
            if not isinstance(part.ctx, ast.Load):
                names.add(mangled(part.id, cls))
        elif isinstance(part, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            is_open = is_open or part.name in _COMPUTING
            names.add(mangled(part.name, cls))
        elif isinstance(part, (ast.keyword, ast.arg)) and part.arg is not None:
            names.update((part.arg, mangled(part.arg, cls)))
        elif isinstance(part, ast.alias):
            names.add((part.asname or part.name).partition('.')[0])
        elif isinstance(part, ast.Constant) and isinstance(part.value, str):
            names.add(part.value)
    return _Text(frozenset(names), is_open)


def _parts(node: ast.AST, cls: str | None) -> Iterator[tuple[ast.AST, str | None]]:
    """Every part with the class around it, without the names that are only asked for."""
    waiting = [(node, cls)]
    while waiting:
        part, within = waiting.pop()
        yield part, within
        inside = part.name if isinstance(part, ast.ClassDef) else within
        known = _known(part) if isinstance(part, ast.Call) else None
        waiting += [(each, inside) for each in ast.iter_child_nodes(part) if each is not known]


def _known(call: ast.Call) -> ast.expr | None:
    """What stores nothing: the name in ``hasattr(x, 'name')``, ``setattr`` where that is known."""
    name = call.args[1] if len(call.args) > 1 else None
    if not isinstance(call.func, ast.Name) or not isinstance(name, ast.Constant):
        return None
    if call.func.id == 'setattr':
        return call.func
    return name if call.func.id in _ASKING else None
