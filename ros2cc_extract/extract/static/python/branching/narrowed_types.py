"""
What ``isinstance`` shows about a name or an attribute that may hold one of several objects.

In an arm of ``if isinstance(self.arm, Mock):`` the expression stands for fewer of them. What it
does not stand for is kept in ``World.ready``, until the branches meet.
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.branching.open_tests import is_assigned_later
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.path_facts import Answer, Facts, Implied, Word
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Const,
    Instance,
    Mystery,
    Value,
    choice,
    options_of,
)


def answer_of(
    machine: Machine, node: ast.Call, function: Value, call: Call, result: Value, frame: Frame
) -> Value:
    """The answer of ``isinstance``, with what it shows about its first argument."""
    text = _text(node.args[0]) if len(node.args) == len(call.args) == len(('of', 'class')) else ''
    if not text or not isinstance(result, Mystery) or not _is_kept(machine, node.args[0], frame):
        return result
    facts: dict[bool, set[tuple[Value, Word]]] = {True: set(), False: set()}
    for option in options_of(call.args[0]):
        answer = machine.call(function, Call(call.place, [option, call.args[1]]))
        if isinstance(answer, Const):
            facts[not answer.value].add((_other(frame, text, option), Word.OTHER))
    if not any(facts.values()):
        return result
    frame.narrowed |= {text}
    return Answer(
        result.unknown,
        node,
        Implied(knows=frozenset(facts[True]), knows_not=frozenset(facts[False])),
    )


def narrowed(machine: Machine, node: ast.expr, value: Value, frame: Frame) -> Value:
    """What an expression may be after the tests that were made of it."""
    text = _text(node)
    if text not in frame.narrowed:
        return value
    options = options_of(value)
    left = [o for o in options if not _is_excluded(machine.world.ready, frame, text, o)]
    return choice(left) if left and len(left) < len(options) else value


def forget(machine: Machine, target: ast.expr, frame: Frame) -> None:
    """Something is stored there that no test has asked about yet."""
    text = _text(target)
    if text in frame.narrowed:
        mine = (frame.scope, text)
        machine.world.ready = frozenset(
            fact
            for fact in machine.world.ready
            if fact[1] is not Word.OTHER or fact[0].value[:2] != mine  # type: ignore[attr-defined]
        )


def _other(frame: Frame, text: str, option: Value) -> Const:
    return Const((frame.scope, text, option))


def _is_excluded(ready: Facts, frame: Frame, text: str, option: Value) -> bool:
    return isinstance(option, Instance) and (_other(frame, text, option), Word.OTHER) in ready


def _text(node: ast.expr) -> str:
    """The text of a name, or of an attribute of one; nothing for other expressions."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        return f'{node.value.id}.{node.attr}'
    return ''


def _is_kept(machine: Machine, node: ast.expr, frame: Frame) -> bool:
    """Whether no other code may store something there between the test and what follows."""
    if isinstance(node, ast.Name):
        return node.id in frame.scope.slots
    owner = machine.evaluate(node.value, frame) if isinstance(node, ast.Attribute) else None
    name = frame.attribute_name(node.attr) if isinstance(node, ast.Attribute) else ''
    return isinstance(owner, Instance) and not is_assigned_later(machine, owner, name)
