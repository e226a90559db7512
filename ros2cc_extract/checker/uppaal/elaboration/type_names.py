"""Elaborates types: ranges, channels, names of typedefs, and the sizes of arrays."""

from __future__ import annotations

from collections.abc import Callable

from ros2cc_extract.checker.uppaal.elaboration.types import (
    BOOL,
    INT16,
    ArrayType,
    ChannelType,
    IntType,
    Scope,
    Type,
    TypeSymbol,
    suggestion,
)
from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.errors import ModelFormatError

_MEND_SUBSET = 'docs/checker.md lists the supported subset'
_MEND_PREFIX = {
    'meta': 'remove the word; a value that is not read again costs no state',
    'hybrid': _MEND_SUBSET,
}


class TypeReader:
    """
    Reads the types of a model.

    :param constant: elaborates a bound or a size, which no state may change.
    """

    def __init__(self, constant: Callable[[syntax.Expression, Scope], int]) -> None:
        self._constant = constant

    def named(self, node: syntax.TypeExpression, scope: Scope) -> Type:
        """Elaborate a type; prefixes but ``const`` are for channels."""
        place = scope.place(node.line)
        for prefix in node.prefixes:
            if prefix in _MEND_PREFIX:
                what = f'{prefix} variables are not supported'
                raise ModelFormatError(what, place, _MEND_PREFIX[prefix])
        if node.base == 'chan':
            return ChannelType('broadcast' in node.prefixes, 'urgent' in node.prefixes)
        if set(node.prefixes) - {'const'}:
            raise ModelFormatError(
                f'{node.prefixes[0]} stands before {node.base}', place, 'only channels have it'
            )
        if node.base == 'bool':
            return BOOL
        if node.base in ('int', 'scalar'):
            return self._int_range(node, scope)
        symbol = scope.find(node.base)
        if isinstance(symbol, TypeSymbol):
            return symbol.type
        if symbol is None and node.base not in ('clock', 'double', 'string', 'void'):
            names = sorted(n for n in scope.visible() if isinstance(scope.find(n), TypeSymbol))
            what = f'there is no type {node.base!r}'
            raise ModelFormatError(what, place, suggestion(node.base, names))
        raise ModelFormatError(
            f'the type {node.base} is outside the supported subset of UPPAAL', place, _MEND_SUBSET
        )

    def _int_range(self, node: syntax.TypeExpression, scope: Scope) -> IntType:
        if node.low is None or node.high is None:
            return IntType(*INT16)
        low, high = self._constant(node.low, scope), self._constant(node.high, scope)
        if low > high:
            raise ModelFormatError(
                f'the range {low}..{high} is empty', scope.place(node.line), 'swap the bounds'
            )
        return IntType(low, high)

    def integer(self, node: syntax.TypeExpression, scope: Scope) -> IntType:
        """Elaborate a type that must be an integer range or bool."""
        found = self.named(node, scope)
        if isinstance(found, IntType):
            return found
        raise ModelFormatError(
            f'{node.base} is no integer type', scope.place(node.line), 'use an integer range'
        )

    def array(self, base: Type, dimensions: tuple[syntax.Dimension, ...], scope: Scope) -> Type:
        """Wrap ``base`` into arrays; a dimension is a size or the type of the index."""
        for dimension in reversed(dimensions):
            length, first = self._size(dimension, scope)
            base = ArrayType(base, length, first)
        return base

    def _size(self, node: syntax.Dimension, scope: Scope) -> tuple[int, int]:
        """Return how many elements there are, and the index of the first."""
        if isinstance(node, syntax.Name):
            symbol = scope.find(node.name)
            if isinstance(symbol, TypeSymbol) and isinstance(symbol.type, IntType):
                return _indices(symbol.type)
        if isinstance(node, syntax.TypeExpression):
            return _indices(self.integer(node, scope))
        length = self._constant(node, scope)
        if length < 1:
            raise ModelFormatError(
                f'an array of {length} elements', scope.place(node.line), 'give it one or more'
            )
        return length, 0


def _indices(index: IntType) -> tuple[int, int]:
    return index.high - index.low + 1, index.low
