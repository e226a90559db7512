"""Elaborates declarations: variables, constants, channels, typedefs and functions."""

from __future__ import annotations

from collections.abc import Iterable

from ros2cc_extract.checker.network.network import Channel, Const, Variable
from ros2cc_extract.checker.uppaal.elaboration.expressions import Expressions
from ros2cc_extract.checker.uppaal.elaboration.network_tables import Tables
from ros2cc_extract.checker.uppaal.elaboration.types import (
    ArrayType,
    ChannelType,
    FunctionSymbol,
    IntType,
    Reference,
    Scope,
    Storage,
    Type,
    TypeSymbol,
    default_value,
    scalar_of,
    size_of,
)
from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.errors import ModelFormatError


class Declarations:
    """
    Declares into scopes and tables; one instance per model.

    ``owner`` is the process a declaration belongs to, empty for global ones; it becomes the
    prefix of the variables' names.
    """

    def __init__(self, tables: Tables, expressions: Expressions) -> None:
        self._tables = tables
        self._expressions = expressions

    def declare(self, nodes: Iterable[syntax.Declaration], scope: Scope, owner: str = '') -> None:
        """Declare all but instantiations and system lines, which are the caller's."""
        for node in nodes:
            if isinstance(node, syntax.Variables):
                self._variables(node, scope, owner)
            elif isinstance(node, syntax.Typedef):
                base = self._expressions.types.named(node.type, scope)
                for alias in node.aliases:
                    named = self._expressions.types.array(base, alias.dimensions, scope)
                    scope.declare(alias.name, TypeSymbol(named), alias.line)
            elif isinstance(node, syntax.Function):
                scope.declare(node.name, FunctionSymbol(node, scope), node.line)

    def _variables(self, node: syntax.Variables, scope: Scope, owner: str) -> None:
        base = self._expressions.types.named(node.type, scope)
        for declarator in node.declarators:
            declared = self._expressions.types.array(base, declarator.dimensions, scope)
            place = scope.place(declarator.line)
            self._tables.check_room(size_of(declared), place)
            if isinstance(scalar_of(declared), ChannelType):
                symbol = self._channels(declarator, declared, owner)
            else:
                values = self._initial(declarator.initial, declared, declarator, scope)
                if 'const' in node.type.prefixes:
                    symbol = _constant(declarator.name, declared, values)
                else:
                    symbol = self._state(declarator, declared, values, owner)
            scope.declare(declarator.name, symbol, declarator.line)

    def _channels(self, node: syntax.Declarator, declared: Type, owner: str) -> Reference:
        base = len(self._tables.channels)
        scalar = scalar_of(declared)
        assert isinstance(scalar, ChannelType)
        for name in _element_names(_qualified(owner, node.name), declared):
            self._tables.channels.append(Channel(name, scalar.is_broadcast, scalar.is_urgent))
        return Reference(node.name, Storage.CHANNEL, declared, base, size_of(declared))

    def _state(
        self, node: syntax.Declarator, declared: Type, values: list[int], owner: str
    ) -> Reference:
        base = len(self._tables.variables)
        scalar = scalar_of(declared)
        assert isinstance(scalar, IntType)
        names = _element_names(_qualified(owner, node.name), declared)
        for name, value in zip(names, values, strict=True):
            self._tables.variables.append(Variable(name, scalar.low, scalar.high, value))
        return Reference(node.name, Storage.STATE, declared, base, size_of(declared))

    def _initial(
        self,
        initial: syntax.Initial | None,
        declared: Type,
        node: syntax.Declarator,
        scope: Scope,
    ) -> list[int]:
        if isinstance(declared, ArrayType):
            return self._initial_array(initial, declared, node, scope)
        assert isinstance(declared, IntType)
        if initial is None:
            return [default_value(declared)]
        if isinstance(initial, tuple):
            raise ModelFormatError(
                f'{node.name} is a single value', scope.place(node.line), 'remove the braces'
            )
        self._expressions.constant(initial, scope)
        value = self._expressions.value(initial, scope)
        coerced = self._expressions.coerced(value, declared, node.name, scope, initial.line)
        assert isinstance(coerced, Const)
        return [coerced.low]

    def _initial_array(
        self,
        initial: syntax.Initial | None,
        declared: ArrayType,
        node: syntax.Declarator,
        scope: Scope,
    ) -> list[int]:
        if initial is None:
            return self._initial(None, declared.element, node, scope) * declared.length
        if not isinstance(initial, tuple) or len(initial) != declared.length:
            raise ModelFormatError(
                f'{node.name} needs {declared.length} initial values',
                scope.place(node.line),
                'list them in braces',
            )
        return [
            value
            for part in initial
            for value in self._initial(part, declared.element, node, scope)
        ]


def _constant(name: str, declared: Type, values: list[int]) -> Reference:
    count = len(values)
    return Reference(name, Storage.CONSTANT, declared, 0, count, values=tuple(values))


def _qualified(owner: str, name: str) -> str:
    return f'{owner}.{name}' if owner else name


def _element_names(name: str, declared: Type) -> list[str]:
    if not isinstance(declared, ArrayType):
        return [name]
    return [
        element
        for i in range(declared.first, declared.first + declared.length)
        for element in _element_names(f'{name}[{i}]', declared.element)
    ]
