"""What the parameters of a call or an instance stand for."""

from __future__ import annotations

from dataclasses import field

from ros2cc_extract.checker.network.network import Const, Expr
from ros2cc_extract.checker.uppaal.elaboration.expressions import Expressions
from ros2cc_extract.checker.uppaal.elaboration.types import (
    ArrayType,
    FunctionSymbol,
    IntType,
    Reference,
    Scope,
    Storage,
    Type,
    scalar_of,
    size_of,
)
from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place


@dataclass(frozen=True)
class Arguments:
    """
    The arguments of one call by the names of the parameters.

    :param copies: of arrays that are passed by value, element by element.
    """

    references: dict[str, Reference] = field(default_factory=dict)
    values: dict[str, tuple[IntType, Expr]] = field(default_factory=dict)
    copies: dict[str, tuple[Expr, ...]] = field(default_factory=dict)

    @property
    def are_constant(self) -> bool:
        """Whether all that is passed by value is one number known beforehand."""
        return not self.copies and all(isinstance(v, Const) for _, v in self.values.values())

    def passed(self, parameters: tuple[syntax.Parameter, ...]) -> tuple[Expr, ...]:
        """Return what fills the first slots of the function's frame, in order."""
        result: list[Expr] = []
        for parameter in parameters:
            if parameter.name in self.values:
                result.append(self.values[parameter.name][1])
            result += self.copies.get(parameter.name, ())
        return tuple(result)


class ArgumentReader:
    """Elaborates the arguments of calls, and what reference parameters are bound to."""

    def __init__(self, expressions: Expressions) -> None:
        self._expressions = expressions

    def of_call(self, node: syntax.Call, symbol: FunctionSymbol, scope: Scope) -> Arguments:
        """Elaborate the arguments of a call; there are as many as parameters."""
        result = Arguments()
        for parameter, argument in zip(symbol.function.parameters, node.arguments, strict=True):
            declared = self.parameter_type(parameter, symbol.scope)
            name = f'parameter {parameter.name} of {symbol.function.name}'
            if parameter.is_reference:
                found = self._expressions.reference(argument, scope)
                bound = self.bound(parameter, declared, found, scope, node)
                result.references[parameter.name] = bound
            elif isinstance(declared, IntType):
                value = self._expressions.value(argument, scope)
                coerced = self._expressions.coerced(value, declared, name, scope, node.line)
                result.values[parameter.name] = declared, coerced
            elif isinstance(scalar_of(declared), IntType):
                copy = self._copied(argument, declared, name, scope)
                result.copies[parameter.name] = copy
            else:
                raise ModelFormatError(
                    f'parameter {parameter.name} takes a copy of a channel',
                    symbol.scope.place(parameter.line),
                    'write & before its name',
                )
        return result

    def _copied(
        self, argument: syntax.Expression, declared: Type, name: str, scope: Scope
    ) -> tuple[Expr, ...]:
        array = self._expressions.array(argument, scope)
        if array is None or _shape(array.type) != _shape(declared):
            what = f'{name} needs an array of its own size'
            raise ModelFormatError(what, scope.place(argument.line), 'name such an array')
        element = scalar_of(declared)
        assert isinstance(element, IntType)
        return tuple(
            self._expressions.coerced(
                self._expressions.load(part, scope, argument.line),
                element,
                name,
                scope,
                argument.line,
            )
            for part in self._expressions.elements(array)
        )

    def parameter_type(self, parameter: syntax.Parameter, scope: Scope) -> Type:
        """Return the declared type of a parameter."""
        base = self._expressions.types.named(parameter.type, scope)
        return self._expressions.types.array(base, parameter.dimensions, scope)

    def bound(
        self,
        parameter: syntax.Parameter,
        declared: Type,
        argument: Reference,
        scope: Scope,
        node: syntax.Call | syntax.Instantiation,
    ) -> Reference:
        """Return what a reference parameter stands for, its type checked."""
        is_same = type(declared) is type(argument.type) and size_of(declared) == size_of(
            argument.type
        )
        mend = None if is_same else 'its type differs from the parameter'
        if argument.storage is Storage.LOCAL:
            mend = 'local variables cannot be passed by reference'
        if not isinstance(argument.offset, Const):
            mend = 'its index is not constant'
        if mend:
            raise ModelFormatError(
                f'{argument.name} cannot stand for parameter {parameter.name}',
                scope.place(node.line),
                mend,
            )
        is_const = 'const' in parameter.type.prefixes
        return Reference(
            parameter.name,
            argument.storage,
            argument.type,
            argument.base,
            argument.length,
            argument.offset,
            argument.values,
            is_const or argument.is_read_only,
        )


def _shape(declared: Type) -> tuple[int, ...]:
    lengths = []
    while isinstance(declared, ArrayType):
        lengths.append(declared.length)
        declared = declared.element
    return tuple(lengths)


def no_function(node: syntax.Expression, place: Place) -> ModelFormatError:
    """Return the error of a call of something else than a function."""
    if isinstance(node, syntax.Member):
        what = f'{node.name} is called from outside its process'
        return ModelFormatError(what, place, 'declare the function globally')
    name = getattr(node, 'name', 'the expression')
    return ModelFormatError(f'{name!r} is no function', place, 'declare it as one')
