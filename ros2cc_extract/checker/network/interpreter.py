"""
Evaluates expressions of a network one node at a time: slow, plain, and the measure of the rest.

The engines must agree with this module; evidence is replayed by it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field
from typing import Any

from ros2cc_extract.checker.network.arithmetic import OPERATIONS
from ros2cc_extract.checker.network.network import (
    MAX_LOOP_STEPS,
    Assign,
    AtLocation,
    Binary,
    Call,
    Check,
    Choice,
    Const,
    DeadlockAtom,
    Element,
    Evaluate,
    Expr,
    ForRange,
    Function,
    If,
    Local,
    LocalElement,
    Network,
    Op,
    Return,
    Site,
    Stmt,
    Table,
    Unary,
    Var,
    While,
)
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass


def site_error(site: Site, value: int) -> ModelFormatError:
    """Return the error of a failed check."""
    return ModelFormatError(site.what.format(value=value), site.place, site.mend)


def endless_error(function: Function) -> ModelFormatError:
    """Return the error of a function that does not end."""
    return ModelFormatError(
        f'{function.name} runs through more than {MAX_LOOP_STEPS} loop passes and calls',
        function.place,
        'make sure that it ends',
    )


@dataclass
class Memory:
    """
    A state that can be written.

    :param locations: one per process.
    :param values: one per variable.
    :param is_deadlock: what the atom ``deadlock`` is here.
    """

    locations: list[int]
    values: list[int]
    is_deadlock: bool = False


@dataclass(frozen=True)
class _Returned:
    value: int


@dataclass(eq=False)
class _Frame:
    function: Function
    slots: list[int]


@dataclass(eq=False)
class Interpreter:
    """Evaluates over one network."""

    network: Network
    _passes: int = 0
    _frames: list[_Frame] = field(default_factory=list)
    _handlers: dict[type, Callable[[Any, Memory], int]] = field(init=False)

    def __post_init__(self) -> None:
        self._handlers = {
            Const: lambda node, memory: node.low,
            Var: lambda node, memory: memory.values[node.slot],
            Element: lambda node, memory: memory.values[
                node.base + self.value(node.index, memory)
            ],
            Table: lambda node, memory: node.values[self.value(node.index, memory)],
            Local: lambda node, memory: self._frames[-1].slots[node.slot],
            LocalElement: self._local_element,
            Unary: self._unary,
            Binary: self._binary,
            Choice: self._choice,
            Check: self._check,
            Call: self._call,
            Assign: self._assign,
            AtLocation: lambda node, memory: int(memory.locations[node.process] == node.location),
            DeadlockAtom: lambda node, memory: int(memory.is_deadlock),
        }

    def value(self, expr: Expr, memory: Memory) -> int:
        """
        Evaluate; assignments write into ``memory``.

        :raises ModelFormatError: a range, index, division or loop bound is broken.
        """
        return self._handlers[type(expr)](expr, memory)

    def _local_element(self, node: LocalElement, memory: Memory) -> int:
        index = self.value(node.index, memory)
        return self._frames[-1].slots[node.base + index]

    def _unary(self, node: Unary, memory: Memory) -> int:
        operand = self.value(node.operand, memory)
        return -operand if node.op is Op.NEG else int(not operand)

    def _binary(self, node: Binary, memory: Memory) -> int:
        left = self.value(node.left, memory)
        if node.op is Op.AND:
            return int(bool(left and self.value(node.right, memory)))
        if node.op is Op.OR:
            return int(bool(left or self.value(node.right, memory)))
        return OPERATIONS[node.op](left, self.value(node.right, memory))

    def _choice(self, node: Choice, memory: Memory) -> int:
        branch = node.then if self.value(node.condition, memory) else node.otherwise
        return self.value(branch, memory)

    def _check(self, node: Check, memory: Memory) -> int:
        value = self.value(node.operand, memory)
        is_good = value != 0 if node.is_zero_bad else node.low <= value <= node.high
        if not is_good:
            raise site_error(self.network.sites[node.site], value)
        return value

    def _assign(self, node: Assign, memory: Memory) -> int:
        # The value first: its evaluation may itself assign.
        value = self.value(node.value, memory)
        target = node.target
        if isinstance(target, Var):
            memory.values[target.slot] = value
        elif isinstance(target, Element):
            memory.values[target.base + self.value(target.index, memory)] = value
        elif isinstance(target, Local):
            self._frames[-1].slots[target.slot] = value
        else:
            self._frames[-1].slots[target.base + self.value(target.index, memory)] = value
        return value

    def _call(self, node: Call, memory: Memory) -> int:
        function = self.network.functions[node.function]
        slots = [self.value(argument, memory) for argument in node.arguments]
        if not self._frames:
            self._passes = 0
        self._frames.append(_Frame(function, slots + [0] * (function.frame - len(slots))))
        try:
            if len(self._frames) > 1:
                self._count(1)
            returned = self._run(function.body, memory)
        finally:
            self._frames.pop()
        return returned.value if returned else 0

    def _run(self, body: Sequence[Stmt], memory: Memory) -> _Returned | None:
        for statement in body:
            returned = self._statement(statement, memory)
            if returned is not None:
                return returned
        return None

    def _statement(self, node: Stmt, memory: Memory) -> _Returned | None:
        if isinstance(node, Evaluate):
            self.value(node.expr, memory)
            return None
        if isinstance(node, Return):
            return _Returned(self.value(node.value, memory) if node.value else 0)
        if isinstance(node, If):
            taken = node.then if self.value(node.condition, memory) else node.otherwise
            return self._run(taken, memory)
        if isinstance(node, ForRange):
            return self._for_range(node, memory)
        return self._while(node, memory)

    def _for_range(self, node: ForRange, memory: Memory) -> _Returned | None:
        self._count(node.high - node.low + 1)
        for value in range(node.low, node.high + 1):
            self._frames[-1].slots[node.slot] = value
            returned = self._run(node.body, memory)
            if returned is not None:
                return returned
        return None

    def _while(self, node: While, memory: Memory) -> _Returned | None:
        while self.value(node.condition, memory):
            self._count(1)
            returned = self._run(node.body, memory)
            if returned is not None:
                return returned
        return None

    def _count(self, passes: int) -> None:
        self._passes += passes
        if self._passes > MAX_LOOP_STEPS:
            raise endless_error(self._frames[-1].function)
