"""Conditions: what depends, on what, and what it is by default."""

from __future__ import annotations

import ast
from collections.abc import Callable
from functools import partial

from ros2cc_extract.extract.static.python.branching import open_tests
from ros2cc_extract.extract.static.python.builtins import builtin_methods, code_behind
from ros2cc_extract.extract.static.python.machine import path_facts
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values import constant_folding
from ros2cc_extract.extract.static.python.values.assumed_defaults import by_default
from ros2cc_extract.extract.static.python.values.containers import Fields
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Const,
    Mystery,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place


def if_expression(machine: Machine, node: ast.IfExp, frame: Frame) -> Value:
    holds = open_tests.decide_expression(machine, node, frame)
    if holds is not None:
        return machine.evaluate(node.body if holds else node.orelse, frame)
    implied = path_facts.implied_by(machine.world.tested)

    def arm(body: ast.expr, *, holds: bool) -> Value:
        machine.world.assume(implied, holds=holds)
        return machine.evaluate(body, frame)

    arms = (partial(arm, node.body, holds=True), partial(arm, node.orelse, holds=False))
    return machine.branch(arms, frame.place(node))


def boolean(machine: Machine, node: ast.BoolOp, frame: Frame) -> Value:
    stops_on = isinstance(node.op, ast.Or)
    found: list[Value] = []
    values: list[Value] = []
    ready = machine.world.ready
    for index, part in enumerate(node.values):
        before = machine.world.changing
        value = machine.evaluate(part, frame)
        if index < len(node.values) - 1:
            code_behind.asked_as(machine, value, 'bool', frame.place(part))
        values.append(value)
        machine.world.assume(path_facts.implied_by(value), holds=not stops_on)
        is_open = machine.world.changing != before
        last = index == len(node.values) - 1
        for option in options_of(value):
            truth = None if is_open else machine.truth(option)
            if truth is None or truth is stops_on or last:
                found.append(option)
        if not is_open and machine.truth(value) is stops_on:
            break
    machine.world.ready = path_facts.back_to(ready, machine.world.ready)
    if len(values) == len(node.values):
        answer = path_facts.joined(values, node)
        if answer is not None:
            return answer
        default = by_default(values, partial(_first_that, machine, stops_on))
        why = next((value.unknown for value in values if isinstance(value, Mystery)), None)
        if default is not None and why is not None:
            return Mystery(why, node, default)
    return choice(found) if found else machine.mystery('condition', frame.place(node))


def _first_that(machine: Machine, stops_on: bool, *values: Value) -> Value:
    stopping = (value for value in values if machine.truth(value) is stops_on)
    return next(stopping, values[-1])


def _negated(machine: Machine, value: Value) -> Value | None:
    truth = machine.truth(value)
    return None if truth is None else Const(not truth)


def _open_condition(
    machine: Machine,
    sides: list[Value],
    act: Callable[..., Value | None],
    node: ast.expr,
    frame: Frame,
) -> Value:
    """A condition that depends, with what it is by default."""
    default = by_default(sides, act)
    why = next((side.unknown for side in sides if isinstance(side, Mystery)), None)
    if default is not None and why is not None:
        return Mystery(why, node, default)
    return machine.mystery('a condition', frame.place(node))


def unary(machine: Machine, node: ast.UnaryOp, frame: Frame) -> Value:
    value = machine.evaluate(node.operand, frame)
    by_code = code_behind.negated(machine, node.op, value, frame.place(node))
    if by_code is not None:
        return by_code
    if isinstance(node.op, ast.Not):
        code_behind.asked_as(machine, value, 'bool', frame.place(node))
        truth = machine.truth(value)
        if truth is not None:
            return Const(not truth)
        answer = path_facts.negated(value, node)
        if answer is not None:
            return answer
        return _open_condition(machine, [value], lambda held: _negated(machine, held), node, frame)
    folded = constant_folding.unary(node.op, value)
    default = by_default([value], partial(constant_folding.unary, node.op))
    if isinstance(value, Mystery) and default is not None:
        return Mystery(value.unknown, node, default)
    return folded or machine.mystery('arithmetic on an unknown value', frame.place(node))


def compare(machine: Machine, node: ast.Compare, frame: Frame) -> Value:
    machine.world.reading.note_comparison(node, frame.module.file, frame.scope.slots)
    machine.world.reading.note_operands(node, frame.module.file)
    before = machine.world.changing
    first = left = machine.evaluate(node.left, frame)
    verdict: bool | None = True
    for operator, right_node in zip(node.ops, node.comparators, strict=True):
        right = machine.evaluate(right_node, frame)
        is_open = _is_answered_by_code(machine, operator, left, right, frame.place(node))
        holds = None if is_open else constant_folding.compare(operator, left, right)
        verdict = False if holds is False else (verdict if holds else None)
        if verdict is False:
            break
        left = right
    if verdict is None or machine.world.changing != before:
        if len(node.ops) > 1:
            return machine.mystery('a condition', frame.place(node))
        answer = path_facts.compared(node.ops[0], first, right, node)
        if answer is not None:
            return answer
        act = partial(_compared, node.ops[0])
        return _open_condition(machine, [first, right], act, node, frame)
    return Const(verdict)


def _is_answered_by_code(
    machine: Machine, operator: ast.cmpop, left: Value, right: Value, place: Place
) -> bool:
    """Whether a method of one of them decides, whose effects are noted; its answer stays open."""
    is_of_items = isinstance(operator, (ast.In, ast.NotIn))
    owner, other = (right, left) if is_of_items else (left, right)
    if is_of_items and isinstance(owner, Fields) and isinstance(other, Const):
        builtin_methods.held_field(machine, owner, str(other.value), place)
        return True
    name = _COMPARISONS.get(type(operator))
    method = machine.special_method(owner, name, place) if name is not None else None
    if method is not None:
        machine.call(method, Call(place, [other]))
    return method is not None


_COMPARISONS: dict[type[ast.cmpop], str] = {
    ast.In: '__contains__',
    ast.NotIn: '__contains__',
    ast.Eq: '__eq__',
    ast.NotEq: '__eq__',
    ast.Lt: '__lt__',
    ast.LtE: '__le__',
    ast.Gt: '__gt__',
    ast.GtE: '__ge__',
}


def _compared(operator: ast.cmpop, left: Value, right: Value) -> Value | None:
    holds = constant_folding.compare(operator, left, right)
    return None if holds is None else Const(holds)
