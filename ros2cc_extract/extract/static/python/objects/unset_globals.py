"""
Globals that known code only sets to ``None``, and that unknown code sets.

Whatever that is, it is one thing wherever the global is used: ``node.create_client(…)`` on ten
lines makes ten clients of one node, not of ten.
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Mystery,
    Scope,
    Value,
)
from ros2cc_extract.source_locations import Unknown

UNSET = 'it is None here and set elsewhere'


def unset_global(
    machine: Machine, node: ast.expr, frame: Frame, reason: str = UNSET
) -> Mystery | None:
    """What ``node`` stands for, if that is a global of the module which is ``None``."""
    if not isinstance(node, ast.Name) or not _is_global(node.id, frame):
        return None
    if frame.module.slots.get(node.id) != NONE:
        return None
    key = (frame.module.file, node.id)
    known = machine.world.unset_globals.get(key)
    if known is None:
        known = Mystery(Unknown(reason, frame.place(node)), node)
        machine.world.unset_globals[key] = known
    return known


def pass_on(machine: Machine, node: ast.Call, call: Call, frame: Frame) -> None:
    """A library is given the thing itself; ``None`` is passed for what no code uses as a thing."""
    if not machine.world.unset_globals:
        return
    for at, text in enumerate(node.args[: len(call.args)]):
        if isinstance(text, ast.Starred):
            break
        call.args[at] = _meant(machine, text, call.args[at], frame)
    for keyword in node.keywords:
        if keyword.arg is not None:
            value = call.keywords[keyword.arg]
            call.keywords[keyword.arg] = _meant(machine, keyword.value, value, frame)


def _meant(machine: Machine, text: ast.expr, value: Value, frame: Frame) -> Value:
    if value != NONE or not isinstance(text, ast.Name) or not _is_global(text.id, frame):
        return value
    return machine.world.unset_globals.get((frame.module.file, text.id), value)


def _is_global(name: str, frame: Frame) -> bool:
    scope: Scope | None = frame.scope
    while scope is not None:
        if name in scope.slots and name not in scope.global_names:
            return scope.slots is frame.module.slots
        scope = scope.parent
    return True
