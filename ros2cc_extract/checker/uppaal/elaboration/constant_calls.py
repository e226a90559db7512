"""
Values of calls with constant arguments, counted out instead of elaborated.

A guard about each of 200 callbacks and each other one calls such a function 40,000 times. What is
not plain arithmetic on constants has no value here, and is elaborated as everything else.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ros2cc_extract.checker.network.arithmetic import BY_SPELLING, OPERATIONS
from ros2cc_extract.checker.network.network import INT32, Const, Op
from ros2cc_extract.checker.uppaal.elaboration.inlining import statements_of
from ros2cc_extract.checker.uppaal.elaboration.types import (
    ArrayType,
    FunctionSymbol,
    IntType,
    Reference,
    Scope,
    Storage,
    ValueSymbol,
)
from ros2cc_extract.checker.uppaal.language import syntax

# Division and shifts have checks of their own.
_PLAIN = {
    spelling: op
    for spelling, op in BY_SPELLING.items()
    if op not in (Op.DIV, Op.MOD, Op.SHL, Op.SHR, Op.AND, Op.OR)
}
#: The declared type of a parameter, or of what a function returns.
TypeOf = Callable[[syntax.TypeExpression, Scope], object]


class NoNumberError(Exception):
    """It has to be elaborated."""


class ConstantCalls:
    """Evaluates calls of functions that were elaborated before, to report their errors."""

    def __init__(self, type_of: TypeOf) -> None:
        self._type_of = type_of
        self._types: dict[FunctionSymbol, tuple[IntType, ...]] = {}

    def of_call(self, symbol: FunctionSymbol, arguments: Sequence[int]) -> int | None:
        """Give the value; nothing where it is not plain arithmetic on constants."""
        try:
            return self._called(symbol, arguments)
        except NoNumberError:
            return None

    def _called(self, symbol: FunctionSymbol, arguments: Sequence[int]) -> int:
        function = symbol.function
        if symbol not in self._types:
            self._types[symbol] = self._types_of(symbol)
        returned, *taken = self._types[symbol]
        if function.body.declarations or len(arguments) != len(taken):
            raise NoNumberError
        names = {
            parameter.name: _converted(value, declared)
            for parameter, value, declared in zip(
                function.parameters, arguments, taken, strict=True
            )
        }
        return _converted(self._returned(function.body.statements, names, symbol.scope), returned)

    def _types_of(self, symbol: FunctionSymbol) -> tuple[IntType, ...]:
        function = symbol.function
        if function.type.base == 'void' or any(
            each.is_reference or each.dimensions for each in function.parameters
        ):
            raise NoNumberError
        written = (function.type, *(parameter.type for parameter in function.parameters))
        types = [self._type_of(each, symbol.scope) for each in written]
        whole = tuple(each for each in types if isinstance(each, IntType))
        if len(whole) != len(types):
            raise NoNumberError
        return whole

    def _returned(
        self, statements: Sequence[syntax.Statement], names: Mapping[str, int], scope: Scope
    ) -> int:
        while statements:
            first = statements[0]
            if isinstance(first, syntax.Return) and first.value is not None:
                return self._value(first.value, names, scope)
            if not isinstance(first, syntax.Branch):
                break
            if self._value(first.condition, names, scope):
                statements = statements_of(first.then)
            else:
                statements = statements_of(first.otherwise) if first.otherwise else statements[1:]
        raise NoNumberError

    def _value(self, node: syntax.Expression, names: Mapping[str, int], scope: Scope) -> int:
        if isinstance(node, syntax.Name):
            return names[node.name] if node.name in names else _constant(node.name, scope)
        if isinstance(node, syntax.Number):
            return _in_range(node.value, *INT32)
        if isinstance(node, syntax.Binary):
            return self._binary(node, names, scope)
        if isinstance(node, syntax.Index):
            return self._element(node, names, scope)
        if isinstance(node, syntax.Unary) and node.operator == '!':
            return int(not self._value(node.operand, names, scope))
        if isinstance(node, syntax.Conditional):
            holds = self._value(node.condition, names, scope)
            return self._value(node.then if holds else node.otherwise, names, scope)
        if isinstance(node, syntax.Call) and isinstance(node.function, syntax.Name):
            symbol = scope.find(node.function.name)
            if isinstance(symbol, FunctionSymbol):
                given = [self._value(each, names, scope) for each in node.arguments]
                return self._called(symbol, given)
        raise NoNumberError

    def _binary(self, node: syntax.Binary, names: Mapping[str, int], scope: Scope) -> int:
        left = self._value(node.left, names, scope)
        if node.operator in ('&&', '||'):
            if bool(left) is (node.operator == '||'):
                return int(bool(left))
            return int(bool(self._value(node.right, names, scope)))
        if node.operator not in _PLAIN:
            raise NoNumberError
        right = self._value(node.right, names, scope)
        return _in_range(OPERATIONS[_PLAIN[node.operator]](left, right), *INT32)

    def _element(self, node: syntax.Index, names: Mapping[str, int], scope: Scope) -> int:
        array = scope.find(node.array.name) if isinstance(node.array, syntax.Name) else None
        if (
            not isinstance(array, Reference)
            or array.name in names
            or array.storage is not Storage.CONSTANT
            or not isinstance(array.type, ArrayType)
            or not isinstance(array.type.element, IntType)
            or array.offset != Const(0, 0)
        ):
            raise NoNumberError
        first = array.type.first
        index = self._value(node.index, names, scope)
        return array.values[_in_range(index, first, first + array.type.length - 1) - first]


def _constant(name: str, scope: Scope) -> int:
    symbol = scope.find(name)
    if isinstance(symbol, ValueSymbol) and isinstance(symbol.expr, Const):
        return symbol.expr.low
    if (
        not isinstance(symbol, Reference)
        or symbol.storage is not Storage.CONSTANT
        or not isinstance(symbol.type, IntType)
        or not isinstance(symbol.offset, Const)
    ):
        raise NoNumberError
    return symbol.values[symbol.offset.low]


def _converted(value: int, declared: IntType) -> int:
    return int(bool(value)) if declared.is_bool else _in_range(value, declared.low, declared.high)


def _in_range(value: int, low: int, high: int) -> int:
    if not low <= value <= high:
        raise NoNumberError
    return value
