"""
Elaborates functions and calls.

A function becomes code once for each set of variables its reference parameters stand for. A body
that is one ``return`` is put in place of the call.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.checker.network.arithmetic import TRUE, choice, const, is_atomic
from ros2cc_extract.checker.network.network import (
    Assign,
    Call,
    Check,
    Const,
    Element,
    Evaluate,
    Expr,
    ForRange,
    Function,
    If,
    Return,
    Site,
    Stmt,
    Var,
    While,
)
from ros2cc_extract.checker.network.traversal import function_expressions, has_effect, walk
from ros2cc_extract.checker.uppaal.elaboration.arguments import (
    ArgumentReader,
    Arguments,
    no_function,
)
from ros2cc_extract.checker.uppaal.elaboration.constant_calls import ConstantCalls
from ros2cc_extract.checker.uppaal.elaboration.expressions import Expressions
from ros2cc_extract.checker.uppaal.elaboration.inlining import is_expression, statements_of
from ros2cc_extract.checker.uppaal.elaboration.types import (
    ArrayType,
    FunctionSymbol,
    IntType,
    Reference,
    Scope,
    Storage,
    Type,
    TypeSymbol,
    ValueSymbol,
    default_value,
    size_of,
)
from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass

_MAX_FRAME = 65536
#: Nodes of an expression that may stand in place of a call; calls inside calls can double them.
_MAX_INLINED = 2_000


@dataclass(eq=False)
class _Frame:
    """Local slots of the function being elaborated, and what it returns."""

    name: str
    returns: IntType | None
    slots: int = 0

    def allocate(self, count: int, scope: Scope, line: int) -> int:
        base = self.slots
        self.slots += count
        if self.slots > _MAX_FRAME:
            raise ModelFormatError(
                f'{self.name} has more than {_MAX_FRAME} local values',
                scope.place(line),
                'make the arrays smaller',
            )
        return base


class FunctionCompiler:
    """Calls and the functions they need; one instance per model."""

    def __init__(self, expressions: Expressions) -> None:
        self._expressions = expressions
        self.arguments = ArgumentReader(expressions)
        self._tables = expressions.tables
        self._known: dict[tuple[object, ...], tuple[int, IntType | None]] = {}
        self._constant_calls: dict[tuple[object, ...], Expr] = {}
        self._open: list[FunctionSymbol] = []
        self._too_large: set[FunctionSymbol] = set()
        self._are_expressions: dict[FunctionSymbol, bool] = {}
        self._counted = ConstantCalls(expressions.types.named)
        self._are_numbers: set[FunctionSymbol] = set()

    def call(self, node: syntax.Call, scope: Scope) -> Expr:
        """Elaborate a call."""
        place = scope.place(node.line)
        symbol = scope.find(node.function.name) if isinstance(node.function, syntax.Name) else None
        if not isinstance(symbol, FunctionSymbol):
            raise no_function(node.function, place)
        function = symbol.function
        if len(node.arguments) != len(function.parameters):
            what = f'{function.name} takes {len(function.parameters)} arguments'
            raise ModelFormatError(what, place, f'{len(node.arguments)} are given')
        if symbol in self._open:
            raise ModelFormatError(
                f'{function.name} calls itself', place, 'recursion is not allowed; use a loop'
            )
        arguments = self.arguments.of_call(node, symbol, scope)
        self._open.append(symbol)
        try:
            if arguments.references or not arguments.are_constant:
                return self._inlined(symbol, arguments) or self._real_call(symbol, arguments)
            # Queries call the same functions with the same constants by the hundred.
            key = (symbol, *(value.low for _, value in arguments.values.values()))
            if key not in self._constant_calls:
                self._constant_calls[key] = self._of_constants(symbol, arguments)
            return self._constant_calls[key]
        finally:
            self._open.pop()

    # -- calls ---------------------------------------------------------------------------
    def _of_constants(self, symbol: FunctionSymbol, arguments: Arguments) -> Expr:
        if symbol in self._are_numbers:
            numbers = [value.low for _, value in arguments.values.values()]
            counted = self._counted.of_call(symbol, numbers)
            if counted is not None:
                return const(counted)
        found = self._inlined(symbol, arguments) or self._real_call(symbol, arguments)
        if isinstance(found, Const):
            # All of its body was elaborated, what is not taken too.
            self._are_numbers.add(symbol)
        return found

    def updates(self, node: syntax.Call, scope: Scope) -> list[Expr] | None:
        """
        Return the assignments of a called function that is nothing but assignments.

        None when it is more than that, or when an argument could change on the way.
        """
        symbol = scope.find(node.function.name) if isinstance(node.function, syntax.Name) else None
        if not isinstance(symbol, FunctionSymbol) or symbol in self._open:
            return None
        body = symbol.function.body
        is_plain = not body.declarations and all(
            isinstance(statement, syntax.ExpressionStatement) for statement in body.statements
        )
        has_all = len(node.arguments) == len(symbol.function.parameters)
        if symbol.function.type.base != 'void' or not is_plain or not has_all:
            return None
        arguments = self.arguments.of_call(node, symbol, scope)
        if not arguments.are_constant:
            return None
        self._open.append(symbol)
        try:
            inner = self._bound_scope(symbol, arguments)
            return [
                update
                for statement in body.statements
                if isinstance(statement, syntax.ExpressionStatement)
                for update in self._expressions.update(statement.expression, inner)
            ]
        finally:
            self._open.pop()

    def _bound_scope(self, symbol: FunctionSymbol, arguments: Arguments) -> Scope:
        scope = symbol.scope.inner()
        scope.names.update(arguments.references)
        for name, (declared, value) in arguments.values.items():
            scope.names[name] = ValueSymbol(declared, value)
        return scope

    def _inlined(self, symbol: FunctionSymbol, arguments: Arguments) -> Expr | None:
        """Return the call as one expression, where the function is one."""
        body, returns = symbol.function.body, self._return_type(symbol)
        if symbol not in self._are_expressions:
            self._are_expressions[symbol] = is_expression(body)
        if returns is None or arguments.copies or not self._are_expressions[symbol]:
            return None
        if not all(is_atomic(value) for _, value in arguments.values.values()):
            return None
        if symbol in self._too_large:
            return None
        scope = self._bound_scope(symbol, arguments)
        for declaration in body.declarations:
            if not self._bind_locals(declaration, scope):
                return None
        found = self._as_expression(body.statements, scope, returns, symbol.function.name)
        if found is not None and len(walk(found)) > _MAX_INLINED:
            self._too_large.add(symbol)
            return None
        return found

    def _bind_locals(self, declaration: syntax.Variables | syntax.Typedef, scope: Scope) -> bool:
        """Let local names stand for their initial values; false where that would not do."""
        if isinstance(declaration, syntax.Typedef):
            return False
        base = self._expressions.types.named(declaration.type, scope)
        if not isinstance(base, IntType):
            return False
        for declarator in declaration.declarators:
            if declarator.dimensions or not isinstance(declarator.initial, syntax.Expression):
                return False
            value = self._expressions.value(declarator.initial, scope)
            line = declarator.line
            coerced = self._expressions.coerced(value, base, declarator.name, scope, line)
            # A check that is evaluated later, or not at all, would be a different program.
            if any(isinstance(node, (Check, Call, Assign)) for node in walk(coerced)):
                return False
            scope.names[declarator.name] = ValueSymbol(base, coerced)
        return True

    def _as_expression(
        self, statements: Sequence[syntax.Statement], scope: Scope, returns: IntType, name: str
    ) -> Expr | None:
        first, rest = statements[0], statements[1:]
        if isinstance(first, syntax.Return):
            assert first.value is not None
            result = self._expressions.value(first.value, scope)
            if has_effect(result, self._tables.functions):
                return None
            return self._expressions.coerced(result, returns, name, scope, first.line)
        assert isinstance(first, syntax.Branch)
        condition = self._expressions.condition(first.condition, scope)
        then = self._as_expression(statements_of(first.then), scope, returns, name)
        otherwise = statements_of(first.otherwise) if first.otherwise else rest
        other = self._as_expression(otherwise, scope, returns, name)
        if then is None or other is None or has_effect(condition, self._tables.functions):
            return None
        return choice(condition, then, other)

    def _real_call(self, symbol: FunctionSymbol, arguments: Arguments) -> Expr:
        bound = arguments.references
        key = (symbol, *((r.storage, r.base, r.offset, r.values) for r in bound.values()))
        if key not in self._known:
            self._known[key] = self._compile(symbol, bound)
        index, returns = self._known[key]
        low, high = (returns.low, returns.high) if returns else (0, 0)
        return Call(low, high, index, arguments.passed(symbol.function.parameters))

    def _return_type(self, symbol: FunctionSymbol) -> IntType | None:
        if symbol.function.type.base == 'void':
            return None
        return self._expressions.types.integer(symbol.function.type, symbol.scope)

    def _compile(
        self, symbol: FunctionSymbol, references: dict[str, Reference]
    ) -> tuple[int, IntType | None]:
        function, returns = symbol.function, self._return_type(symbol)
        frame = _Frame(function.name, returns)
        scope = symbol.scope.inner()
        parameters = 0
        for parameter in function.parameters:
            if parameter.name in references:
                symbol_of = references[parameter.name]
            else:
                declared = self.arguments.parameter_type(parameter, symbol.scope)
                is_const = 'const' in parameter.type.prefixes
                symbol_of = _local(
                    frame, parameter.name, declared, scope, parameter.line, is_const
                )
                parameters += size_of(declared)
            scope.declare(parameter.name, symbol_of, parameter.line)
        body = self._block(function.body, scope, frame)
        place = scope.place(function.line)
        if returns is not None and not _always_returns(body):
            site = Site(place, f'{function.name} ended without return', 'return on every path')
            body.append(Return(self._tables.failure(site)))
        self._tables.functions.append(
            Function(
                function.name,
                parameters,
                frame.slots,
                tuple(body),
                self._writes_state(body),
                place,
            )
        )
        return len(self._tables.functions) - 1, returns

    def _writes_state(self, body: Sequence[Stmt]) -> bool:
        functions = self._tables.functions
        for expr in function_expressions(body):
            for node in walk(expr):
                if isinstance(node, Assign) and isinstance(node.target, (Var, Element)):
                    return True
                if isinstance(node, Call) and functions[node.function].writes:
                    return True
        return False

    # -- statements ----------------------------------------------------------------------
    def _block(self, block: syntax.Block, scope: Scope, frame: _Frame) -> list[Stmt]:
        inner = scope.inner()
        result: list[Stmt] = []
        for declaration in block.declarations:
            base = self._expressions.types.named(declaration.type, inner)
            if isinstance(declaration, syntax.Typedef):
                for alias in declaration.aliases:
                    named = self._expressions.types.array(base, alias.dimensions, inner)
                    inner.declare(alias.name, TypeSymbol(named), alias.line)
                continue
            is_const = 'const' in declaration.type.prefixes
            for declarator in declaration.declarators:
                result += self._local_variable(declarator, base, is_const, inner, frame)
        for statement in block.statements:
            result += self._statement(statement, inner, frame)
        return result

    def _local_variable(
        self,
        declarator: syntax.Declarator,
        base: Type,
        is_const: bool,
        scope: Scope,
        frame: _Frame,
    ) -> list[Stmt]:
        declared = self._expressions.types.array(base, declarator.dimensions, scope)
        line = declarator.line
        whole = _local(frame, declarator.name, declared, scope, line, False)
        cells = self._expressions.elements(whole)
        initials = self._initials(declarator.initial, declared, scope, line)
        scope.declare(
            declarator.name,
            Reference(
                whole.name,
                whole.storage,
                declared,
                whole.base,
                whole.length,
                is_read_only=is_const,
            ),
            line,
        )
        return [
            Evaluate(self._expressions.assignment(cell, value, scope, line))
            for cell, value in zip(cells, initials, strict=True)
        ]

    def _initials(
        self, initial: syntax.Initial | None, declared: Type, scope: Scope, line: int
    ) -> list[Expr]:
        if isinstance(declared, ArrayType):
            if initial is None:
                parts: Sequence[syntax.Initial | None] = [None] * declared.length
            elif isinstance(initial, tuple) and len(initial) == declared.length:
                parts = initial
            else:
                raise ModelFormatError(
                    f'the array needs {declared.length} initial values',
                    scope.place(line),
                    'list them in braces',
                )
            return [
                value
                for part in parts
                for value in self._initials(part, declared.element, scope, line)
            ]
        if isinstance(initial, tuple) or not isinstance(declared, IntType):
            raise ModelFormatError(
                'the initial value does not fit the type', scope.place(line), 'give one number'
            )
        if initial is None:
            return [const(default_value(declared))]
        return [self._expressions.value(initial, scope)]

    def _statement(self, node: syntax.Statement, scope: Scope, frame: _Frame) -> list[Stmt]:
        if isinstance(node, syntax.Block):
            return self._block(node, scope, frame)
        if isinstance(node, syntax.ExpressionStatement):
            return [Evaluate(e) for e in self._expressions.update(node.expression, scope)]
        if isinstance(node, syntax.Branch):
            condition = self._expressions.condition(node.condition, scope)
            then = tuple(self._statement(node.then, scope, frame))
            other = self._statement(node.otherwise, scope, frame) if node.otherwise else []
            return [If(condition, then, tuple(other))]
        if isinstance(node, syntax.Iteration):
            return self._iteration(node, scope, frame)
        if isinstance(node, syntax.Loop):
            return self._loop(node, scope, frame)
        return [self._return(node, scope, frame)]

    def _iteration(self, node: syntax.Iteration, scope: Scope, frame: _Frame) -> list[Stmt]:
        over = self._expressions.types.integer(node.type, scope)
        inner = scope.inner()
        line = node.type.line
        variable = _local(frame, node.variable, over, scope, line, True)
        inner.declare(node.variable, variable, line)
        body = self._statement(node.body, inner, frame)
        return [ForRange(variable.base, over.low, over.high, tuple(body))]

    def _loop(self, node: syntax.Loop, scope: Scope, frame: _Frame) -> list[Stmt]:
        condition = self._expressions.condition(node.condition, scope) if node.condition else TRUE
        body = self._statement(node.body, scope, frame)
        body += self._effects(node.steps, scope)
        first = self._effects(node.start, scope)
        if not node.tests_first:
            first += self._statement(node.body, scope, frame)
        return [*first, While(condition, tuple(body))]

    def _effects(self, nodes: Sequence[syntax.Expression], scope: Scope) -> list[Stmt]:
        return [Evaluate(e) for node in nodes for e in self._expressions.update(node, scope)]

    def _return(self, node: syntax.Return, scope: Scope, frame: _Frame) -> Return:
        if (node.value is None) != (frame.returns is None):
            raise ModelFormatError(
                f'{frame.name} returns a value on some paths only',
                scope.place(node.line),
                'return what the declared type says',
            )
        if node.value is None or frame.returns is None:
            return Return(None)
        value = self._expressions.value(node.value, scope)
        name = f'the result of {frame.name}'
        return Return(self._expressions.coerced(value, frame.returns, name, scope, node.line))


def _local(
    frame: _Frame, name: str, declared: Type, scope: Scope, line: int, is_read_only: bool
) -> Reference:
    count = size_of(declared)
    base = frame.allocate(count, scope, line)
    return Reference(name, Storage.LOCAL, declared, base, count, is_read_only=is_read_only)


def _always_returns(body: Sequence[Stmt]) -> bool:
    if not body:
        return False
    last = body[-1]
    if isinstance(last, If):
        return _always_returns(last.then) and _always_returns(last.otherwise)
    if isinstance(last, While):
        return last.condition == TRUE
    return isinstance(last, Return)
