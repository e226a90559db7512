"""Which processes a model has: instantiations, partial ones, and the system line."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from ros2cc_extract.checker.network.arithmetic import const
from ros2cc_extract.checker.uppaal.elaboration.expressions import Expressions
from ros2cc_extract.checker.uppaal.elaboration.functions import FunctionCompiler
from ros2cc_extract.checker.uppaal.elaboration.types import (
    ArrayType,
    ChannelType,
    IntType,
    Reference,
    Scope,
    Storage,
    Symbol,
    ValueSymbol,
)
from ros2cc_extract.checker.uppaal.files.document import TemplateNode
from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass

MAX_PROCESSES = 4096


@dataclass(frozen=True)
class Definition:
    """
    A template, or a (partial) instance of one.

    :param arguments: empty for the template itself, whose ``of`` is None.
    """

    name: str
    parameters: tuple[syntax.Parameter, ...]
    node: TemplateNode
    of: Definition | None = None
    arguments: tuple[syntax.Expression, ...] = ()
    line: int = 0


@dataclass(frozen=True)
class Instance:
    """A process to be: its name, its template, and what the template's parameters stand for."""

    name: str
    node: TemplateNode
    bindings: dict[str, Symbol]


class Instances:
    """Resolves names of the system line to instances."""

    def __init__(
        self,
        expressions: Expressions,
        functions: FunctionCompiler,
        scope: Scope,
        templates: dict[str, Definition],
    ) -> None:
        self._expressions = expressions
        self._functions = functions
        self._scope = scope
        self._known = templates

    def define(self, node: syntax.Instantiation) -> None:
        """Add the name that an instantiation defines."""
        of = self._definition(node.template, node.line)
        if node.name in self._known or node.name in self._scope.names:
            raise ModelFormatError(
                f'{node.name!r} is declared twice', self._scope.place(node.line), 'rename one'
            )
        if len(node.arguments) != len(of.parameters):
            what = f'{of.name} takes {len(of.parameters)} arguments'
            mend = f'{len(node.arguments)} are given'
            raise ModelFormatError(what, self._scope.place(node.line), mend)
        self._known[node.name] = Definition(
            node.name, node.parameters, of.node, of, node.arguments, node.line
        )
        if not node.parameters:
            # An argument outside its range is an error even if the process is never used.
            self._bind(self._known[node.name], {})

    def of_system_line(self, name: str, line: int) -> list[Instance]:
        """Return the process of that name, or one for each value of its free parameters."""
        definition = self._definition(name, line)
        if not definition.parameters:
            return [Instance(name, definition.node, self._bind(definition, {}))]
        ranges = [self._free(parameter, definition, line) for parameter in definition.parameters]
        count = 1
        for values in ranges:
            count *= values.high - values.low + 1
        if count > MAX_PROCESSES:
            raise ModelFormatError(
                f'{name} makes {count} processes', self._scope.place(line), 'narrow its parameters'
            )
        return [
            self._numbered(definition, ranges, values)
            for values in itertools.product(*(range(r.low, r.high + 1) for r in ranges))
        ]

    def _numbered(
        self, definition: Definition, ranges: Sequence[IntType], values: tuple[int, ...]
    ) -> Instance:
        own: dict[str, Symbol] = {
            parameter.name: ValueSymbol(declared, const(value))
            for parameter, declared, value in zip(
                definition.parameters, ranges, values, strict=True
            )
        }
        name = f'{definition.name}({",".join(map(str, values))})'
        return Instance(name, definition.node, self._bind(definition, own))

    def _free(self, parameter: syntax.Parameter, of: Definition, line: int) -> IntType:
        declared = self._functions.arguments.parameter_type(parameter, self._scope)
        if parameter.is_reference or not isinstance(declared, IntType):
            raise ModelFormatError(
                f'parameter {parameter.name} of {of.name} has no value',
                self._scope.place(line),
                f'instantiate {of.name} with arguments',
            )
        return declared

    def _definition(self, name: str, line: int) -> Definition:
        found = self._known.get(name)
        if found is None:
            known = ', '.join(list(self._known)[:8])
            raise ModelFormatError(
                f'there is no template or process {name!r}',
                self._scope.place(line),
                f'known are {known}' if known else 'add a template',
            )
        return found

    def _bind(self, definition: Definition, own: dict[str, Symbol]) -> dict[str, Symbol]:
        """Return the bindings of the template's parameters, given those of ``definition``."""
        while definition.of is not None:
            scope = self._scope.inner()
            scope.names.update(own)
            own = {
                parameter.name: self._argument(parameter, argument, definition, scope)
                for parameter, argument in zip(
                    definition.of.parameters, definition.arguments, strict=True
                )
            }
            definition = definition.of
        return own

    def _argument(
        self,
        parameter: syntax.Parameter,
        argument: syntax.Expression,
        definition: Definition,
        scope: Scope,
    ) -> Symbol:
        assert definition.of is not None
        declared = self._functions.arguments.parameter_type(parameter, self._scope)
        if parameter.is_reference:
            found = self._expressions.reference(argument, scope)
            node = syntax.Instantiation(definition.name, (), definition.of.name, (), argument.line)
            return self._functions.arguments.bound(parameter, declared, found, scope, node)
        if isinstance(declared, ChannelType):
            raise ModelFormatError(
                f'parameter {parameter.name} of {definition.of.name} takes a copy of a channel',
                scope.place(argument.line),
                'write & before its name',
            )
        if isinstance(declared, ArrayType):
            return self._constant_array(parameter, argument, scope)
        self._expressions.constant(argument, scope)
        name = f'parameter {parameter.name} of {definition.of.name}'
        value = self._expressions.value(argument, scope)
        coerced = self._expressions.coerced(value, declared, name, scope, argument.line)
        return ValueSymbol(declared, coerced)

    def _constant_array(
        self, parameter: syntax.Parameter, argument: syntax.Expression, scope: Scope
    ) -> Reference:
        found = self._expressions.reference(argument, scope)
        if found.storage is Storage.CONSTANT:
            return found
        raise ModelFormatError(
            f'parameter {parameter.name} takes a copy of a variable array',
            scope.place(argument.line),
            'write & before its name',
        )
