"""``eval`` and ``exec`` of a text that stands in the program: it is followed like the rest."""

from __future__ import annotations

import ast
from contextlib import suppress

from ros2cc_extract.extract.static.python.builtins import computed_names
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Mapping
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Instance,
    Library,
    Native,
    Scope,
    Value,
    options_of,
)

_EVAL, _EXEC, _COMPILE = 'builtins.eval', 'builtins.exec', 'builtins.compile'
_LONGEST = 10_000


def executed(
    machine: Machine, function: Value, call: Call, node: ast.Call, frame: Frame
) -> Value | None:
    """The result of ``function``, if it runs a text that is known."""
    name = function.name if isinstance(function, (Library, Native)) else ''
    given = call.args[0] if call.args else None
    if name not in (_EVAL, _EXEC, _COMPILE) or given is None:
        return None
    texts = [option.value for option in options_of(given) if isinstance(option, Const)]
    known = [text for text in texts if isinstance(text, str) and len(text) < _LONGEST]
    if len(known) != len(options_of(given)):
        owner = frame.scope.slots.get('self')
        if name != _COMPILE and isinstance(owner, Instance):
            computed_names.note_any_called(machine, owner, name.rpartition('.')[2], call.place)
        return None
    if name == _COMPILE:
        return given  # ``eval`` and ``exec`` take the text as well
    inner = _frame(machine, call, frame)
    return machine.each(
        given, lambda text: _followed(machine, text, name, node, inner), call.place
    )


def _followed(machine: Machine, text: Value, name: str, node: ast.Call, frame: Frame) -> Value:
    assert isinstance(text, Const)
    kept = node.__dict__.setdefault('texts', {})
    if (name, text.value) not in kept:
        kept[name, text.value] = _parsed(text.value, name, node)
    tree: ast.Module | ast.Expression | None = kept[name, text.value]
    if isinstance(tree, ast.Expression):
        return machine.evaluate(tree.body, frame)
    if tree is not None:
        machine.execute_block(tree.body, frame)
        return NONE
    return machine.mystery('a text that is no program', frame.place(node))


def _parsed(text: str, name: str, node: ast.Call) -> ast.Module | ast.Expression | None:
    tree: ast.Module | ast.Expression | None = None
    with suppress(SyntaxError, ValueError, RecursionError, MemoryError):
        tree = ast.parse(text) if name == _EXEC else ast.parse(text.strip(), mode='eval')
    for part in ast.walk(tree) if tree is not None else ():
        if 'lineno' in part._attributes:
            ast.copy_location(part, node)  # it stands where it is run
    return tree


def _frame(machine: Machine, call: Call, frame: Frame) -> Frame:
    """The names that the text has: those given, or those of the code around."""
    names = [call.argument(1, 'globals'), call.argument(2, 'locals')]
    given = [each for each in names if isinstance(each, Mapping)]
    if not given:
        return frame
    scope = Scope(frame.module, frame.scope)
    inner = Frame(scope, frame.function, qualname=frame.qualname, path=machine.world.path)
    for mapping in given:
        for key, value in mapping.entries.items():
            if isinstance(key, Const):
                scope.slots[str(key.value)] = value
    return inner
