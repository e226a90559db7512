"""Partial evaluation: an expression where some variables and one location are known."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ros2cc_extract.checker.network.arithmetic import binary, choice, const, minus, negation
from ros2cc_extract.checker.network.network import (
    Assign,
    AtLocation,
    Binary,
    Call,
    Check,
    Choice,
    Const,
    Element,
    Expr,
    LocalElement,
    Op,
    Table,
    Unary,
    Var,
)


class Substitution:
    """
    What is known.

    :param values: variables by slot.
    :param at: a process and its location.
    """

    def __init__(self, values: Mapping[int, int], at: tuple[int, int] | None = None) -> None:
        self._values = values
        self._at = at
        self._handlers: dict[type, Callable[[Any], Expr]] = {
            Var: self._var,
            Element: self._element,
            Table: self._table,
            LocalElement: lambda node: LocalElement(
                node.low, node.high, node.base, node.length, self.apply(node.index)
            ),
            Unary: self._unary,
            Binary: self._binary,
            Choice: self._choice,
            Check: self._check,
            Call: lambda node: Call(
                node.low, node.high, node.function, tuple(map(self.apply, node.arguments))
            ),
            Assign: self._assign,
            AtLocation: self._at_location,
        }

    def apply(self, expr: Expr) -> Expr:
        """Return the simplified expression; it has the same value in every state that fits."""
        handler = self._handlers.get(type(expr))
        return handler(expr) if handler else expr

    def _var(self, node: Var) -> Expr:
        return const(self._values[node.slot]) if node.slot in self._values else node

    def _element(self, node: Element) -> Expr:
        index = self.apply(node.index)
        if isinstance(index, Const):
            return self._var(Var(node.low, node.high, node.base + index.low))
        return Element(node.low, node.high, node.base, node.length, index)

    def _table(self, node: Table) -> Expr:
        index = self.apply(node.index)
        if isinstance(index, Const):
            return const(node.values[index.low])
        return Table(node.low, node.high, node.values, index)

    def _unary(self, node: Unary) -> Expr:
        operand = self.apply(node.operand)
        return minus(operand) if node.op is Op.NEG else negation(operand)

    def _binary(self, node: Binary) -> Expr:
        left, right = self.apply(node.left), self.apply(node.right)
        return binary(node.op, left, right)

    def _choice(self, node: Choice) -> Expr:
        condition = self.apply(node.condition)
        if isinstance(condition, Const):
            return self.apply(node.then if condition.low else node.otherwise)
        return choice(condition, self.apply(node.then), self.apply(node.otherwise))

    def _check(self, node: Check) -> Expr:
        operand = self.apply(node.operand)
        if isinstance(operand, Const):
            is_good = (
                operand.low != 0 if node.is_zero_bad else (node.low <= operand.low <= node.high)
            )
            if is_good:
                return operand
        return Check(node.low, node.high, operand, node.site, node.is_zero_bad)

    def _assign(self, node: Assign) -> Expr:
        target = node.target
        if isinstance(target, Element):
            index = self.apply(target.index)
            if isinstance(index, Const):
                target = Var(target.low, target.high, target.base + index.low)
            else:
                target = Element(target.low, target.high, target.base, target.length, index)
        return Assign(node.low, node.high, target, self.apply(node.value))

    def _at_location(self, node: AtLocation) -> Expr:
        if self._at is not None and self._at[0] == node.process:
            return const(int(self._at[1] == node.location))
        return node
