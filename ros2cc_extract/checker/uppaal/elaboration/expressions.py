"""Elaborates expressions: names become slots, types and ranges are checked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from ros2cc_extract.checker.network.arithmetic import (
    BY_SPELLING,
    TRUE,
    binary,
    choice,
    const,
    fits_32_bits,
    folded,
    minus,
    negation,
    truth,
)
from ros2cc_extract.checker.network.network import (
    INT32,
    Assign,
    AtLocation,
    Const,
    DeadlockAtom,
    Element,
    Expr,
    Local,
    LocalElement,
    Op,
    Site,
    Table,
    Target,
    Var,
)
from ros2cc_extract.checker.network.traversal import has_effect
from ros2cc_extract.checker.uppaal.elaboration.network_tables import Tables
from ros2cc_extract.checker.uppaal.elaboration.type_names import TypeReader
from ros2cc_extract.checker.uppaal.elaboration.types import (
    RESERVED,
    ArrayType,
    IntType,
    ProcessSymbol,
    Reference,
    Scope,
    Storage,
    TypeSymbol,
    ValueSymbol,
    scalar_of,
    size_of,
    suggestion,
)
from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.errors import ModelFormatError

MAX_QUANTIFIED = 4096
#: Terms that the quantifiers of one expression may unfold into, those inside others included.
MAX_TERMS = 200_000
_MEND_SIZE = 'name an array that has as many elements'
_MEND_NAME = 'name a variable'


class Calls(Protocol):
    """What expressions need of calls, which are made of expressions themselves."""

    def call(self, node: syntax.Call, scope: Scope) -> Expr:
        """Elaborate a call."""

    def updates(self, node: syntax.Call, scope: Scope) -> list[Expr] | None:
        """Return the assignments of a called function that is nothing else, or None."""


class Expressions:
    """
    One instance elaborates all expressions of a model.

    :param calls: set right after construction.
    """

    calls: Calls

    def __init__(self, tables: Tables) -> None:
        self.tables = tables
        self.types = TypeReader(self.constant)
        self._terms, self._quantifiers = 0, 0
        self._handlers: dict[type, Callable[[Any, Scope], Expr]] = {
            syntax.Name: self._value_of,
            syntax.Index: self._value_of,
            syntax.Member: self._value_of,
            syntax.Number: self._number,
            syntax.DeadlockAtom: self._deadlock,
            syntax.Unary: self._unary,
            syntax.Binary: self._binary,
            syntax.Conditional: self._conditional,
            syntax.Assign: self._assign,
            syntax.Step: self._step,
            syntax.Quantifier: self._quantifier,
            syntax.Call: self._call,
        }

    # -- values --------------------------------------------------------------------------
    def value(self, node: syntax.Expression, scope: Scope) -> Expr:
        """Elaborate an expression that has an integer value."""
        return self._handlers[type(node)](node, scope)

    def condition(self, node: syntax.Expression, scope: Scope) -> Expr:
        """Elaborate an expression that is used as a truth value."""
        return truth(self.value(node, scope))

    def pure(self, node: syntax.Expression, scope: Scope, where: str) -> Expr:
        """Elaborate a value whose evaluation must not assign anything."""
        expr = self.value(node, scope)
        if has_effect(expr, self.tables.functions):
            raise ModelFormatError(
                f'{where} changes variables', scope.place(node.line), 'move it into an update'
            )
        return expr

    def constant(self, node: syntax.Expression, scope: Scope) -> int:
        """Elaborate an expression whose value must be known without a state."""
        expr = self.value(node, scope)
        if not isinstance(expr, Const):
            raise ModelFormatError(
                'the value is not known before the model runs',
                scope.place(node.line),
                'use constants here',
            )
        return expr.low

    def coerced(self, expr: Expr, declared: IntType, name: str, scope: Scope, line: int) -> Expr:
        """Convert a value to the type of ``name``, checking its range."""
        if declared.is_bool:
            return truth(expr)
        what = f'{{value}} is outside the range {declared.low}..{declared.high} of {name}'
        site = Site(scope.place(line), what, 'widen the range or guard the assignment')
        return self.tables.checked(expr, declared.low, declared.high, site)

    def load(self, reference: Reference, scope: Scope, line: int) -> Expr:
        """Read a scalar."""
        declared = reference.type
        if not isinstance(declared, IntType):
            kind = 'an array' if isinstance(declared, ArrayType) else 'a channel'
            raise ModelFormatError(
                f'{reference.name} is {kind}, not a value',
                scope.place(line),
                'name one element' if kind == 'an array' else 'use it in a synchronisation',
            )
        if reference.storage is Storage.CONSTANT:
            return self._load_constant(reference)
        return self._target(reference, declared)

    def _load_constant(self, reference: Reference) -> Expr:
        if isinstance(reference.offset, Const):
            return const(reference.values[reference.offset.low])
        values = reference.values
        return Table(min(values), max(values), values, reference.offset)

    def _target(self, reference: Reference, declared: IntType) -> Target:
        low, high, base, offset = declared.low, declared.high, reference.base, reference.offset
        is_local = reference.storage is Storage.LOCAL
        if isinstance(offset, Const):
            return (Local if is_local else Var)(low, high, base + offset.low)
        kind = LocalElement if is_local else Element
        return kind(low, high, base, reference.length, offset)

    def _value_of(self, node: syntax.Expression, scope: Scope) -> Expr:
        if isinstance(node, syntax.Name):
            symbol = scope.find(node.name)
            if isinstance(symbol, ValueSymbol):
                return symbol.expr
        if isinstance(node, syntax.Member):
            process = self._process(node.owner, scope)
            if node.name in process.locations:
                return AtLocation(0, 1, process.index, process.locations[node.name])
        return self.load(self.reference(node, scope), scope, node.line)

    def _number(self, node: syntax.Number, scope: Scope) -> Expr:
        if node.value > INT32[1]:
            raise ModelFormatError(
                'the number does not fit into 32 bits', scope.place(node.line), 'make it smaller'
            )
        return const(node.value)

    def _deadlock(self, node: syntax.DeadlockAtom, scope: Scope) -> Expr:
        return DeadlockAtom(0, 1)

    # -- operators -----------------------------------------------------------------------
    def _unary(self, node: syntax.Unary, scope: Scope) -> Expr:
        operand = self.value(node.operand, scope)
        if node.operator == '!':
            return negation(truth(operand))
        return operand if node.operator == '+' else self._in_32_bits(minus(operand), node, scope)

    def _binary(self, node: syntax.Binary, scope: Scope) -> Expr:
        if node.operator == 'imply':
            premise = negation(self.condition(node.left, scope))
            return binary(Op.OR, premise, self.condition(node.right, scope))
        if node.operator == 'xor':
            left, right = self.condition(node.left, scope), self.condition(node.right, scope)
            return binary(Op.NE, left, right)
        if node.operator in ('==', '!='):
            arrays = self._array_comparison(node, scope)
            if arrays is not None:
                return arrays
        left, right = self.value(node.left, scope), self.value(node.right, scope)
        return self.operation(BY_SPELLING[node.operator], left, right, node, scope)

    def operation(
        self, op: Op, left: Expr, right: Expr, node: syntax.Expression, scope: Scope
    ) -> Expr:
        """Combine two values with the checks the operator needs."""
        place = scope.place(node.line)
        if op in (Op.DIV, Op.MOD):
            right = self.tables.nonzero(right, Site(place, 'division by zero', 'guard it'))
        elif op in (Op.SHL, Op.SHR):
            site = Site(place, 'shift by {value} bits', 'shift by 0 to 31 bits')
            right = self.tables.checked(right, 0, 31, site)
        if op in (Op.AND, Op.OR):
            left, right = truth(left), truth(right)
        return self._in_32_bits(binary(op, left, right), node, scope)

    def _in_32_bits(self, expr: Expr, node: syntax.Expression, scope: Scope) -> Expr:
        if fits_32_bits(expr):
            return expr
        site = Site(scope.place(node.line), '{value} does not fit into 32 bits', 'narrow ranges')
        return self.tables.checked(expr, *INT32, site)

    def _array_comparison(self, node: syntax.Binary, scope: Scope) -> Expr | None:
        left = self.array(node.left, scope)
        right = self.array(node.right, scope) if left else None
        if left is None or right is None:
            return None
        if left.type != right.type and size_of(left.type) != size_of(right.type):
            raise ModelFormatError(
                'arrays of different sizes are compared', scope.place(node.line), 'compare parts'
            )
        pairs = zip(self.elements(left), self.elements(right), strict=True)
        equal = [
            binary(Op.EQ, self.load(a, scope, node.line), self.load(b, scope, node.line))
            for a, b in pairs
        ]
        both = folded(Op.AND, equal, TRUE)
        return both if node.operator == '==' else negation(both)

    def _conditional(self, node: syntax.Conditional, scope: Scope) -> Expr:
        condition = self.condition(node.condition, scope)
        return choice(condition, self.value(node.then, scope), self.value(node.otherwise, scope))

    def _quantifier(self, node: syntax.Quantifier, scope: Scope) -> Expr:
        over = self.types.integer(node.type, scope)
        if over.high - over.low >= MAX_QUANTIFIED:
            raise ModelFormatError(
                f'{node.kind} over more than {MAX_QUANTIFIED} values',
                scope.place(node.line),
                'narrow the type',
            )
        terms = self._unfolded(node, over, scope)
        if node.kind == 'sum':
            total: Expr = const(0)
            for term in terms:
                total = self.operation(Op.ADD, total, term, node, scope)
            return total
        op = Op.AND if node.kind == 'forall' else Op.OR
        return folded(op, [truth(term) for term in terms], const(int(op is Op.AND)))

    def _unfolded(self, node: syntax.Quantifier, over: IntType, scope: Scope) -> list[Expr]:
        self._terms = (self._terms if self._quantifiers else 0) + over.high - over.low + 1
        if self._terms > MAX_TERMS:
            what = f'quantifiers inside quantifiers unfold into more than {MAX_TERMS} terms'
            raise ModelFormatError(what, scope.place(node.line), 'narrow their types')
        terms = []
        self._quantifiers += 1
        try:
            for value in range(over.low, over.high + 1):
                inner = scope.inner()
                inner.names[node.variable] = ValueSymbol(over, const(value))
                terms.append(self.value(node.body, inner))
        finally:
            self._quantifiers -= 1
        return terms

    # -- assignments ---------------------------------------------------------------------
    def _assign(self, node: syntax.Assign, scope: Scope) -> Expr:
        if self.array(node.target, scope):
            raise ModelFormatError(
                'the value of an array assignment is used',
                scope.place(node.line),
                'assign arrays in a step of their own',
            )
        reference = self._writable(node.target, scope)
        value = self.value(node.value, scope)
        if node.operator:
            old = self.load(reference, scope, node.line)
            value = self.operation(BY_SPELLING[node.operator], old, value, node, scope)
        return self.assignment(reference, value, scope, node.line)

    def assignment(self, reference: Reference, value: Expr, scope: Scope, line: int) -> Assign:
        """Write a value, converted to the type of the scalar it goes to."""
        target = self.load(reference, scope, line)
        declared = reference.type
        assert isinstance(declared, IntType)
        assert isinstance(target, (Var, Element, Local, LocalElement))
        checked = self.coerced(value, declared, reference.name, scope, line)
        return Assign(checked.low, checked.high, target, checked)

    def _writable(self, node: syntax.Expression, scope: Scope) -> Reference:
        if isinstance(node, syntax.Name) and isinstance(scope.find(node.name), ValueSymbol):
            raise self._read_only(node.name, scope, node.line)
        reference = self.reference(node, scope)
        if reference.storage is Storage.CONSTANT or reference.is_read_only:
            raise self._read_only(reference.name, scope, node.line)
        self.load(reference, scope, node.line)
        return reference

    def _read_only(self, name: str, scope: Scope, line: int) -> ModelFormatError:
        return ModelFormatError(
            f'{name} is constant and cannot be assigned', scope.place(line), 'use a variable'
        )

    def _step(self, node: syntax.Step, scope: Scope) -> Expr:
        reference = self._writable(node.target, scope)
        amount = const(node.amount)
        old = self.load(reference, scope, node.line)
        new = self.operation(Op.ADD, old, amount, node, scope)
        assigned = self.assignment(reference, new, scope, node.line)
        return assigned if node.is_prefix else binary(Op.SUB, assigned, amount)

    def update(self, node: syntax.Expression, scope: Scope) -> list[Expr]:
        """Elaborate an expression for its effect; array assignments become many."""
        if isinstance(node, syntax.Assign) and not node.operator:
            target = self.array(node.target, scope)
            if target is not None:
                return self._array_assignment(node, target, scope)
        if isinstance(node, syntax.Call):
            inlined = self.calls.updates(node, scope)
            if inlined is not None:
                return inlined
        return [self.value(node, scope)]

    def _array_assignment(
        self, node: syntax.Assign, target: Reference, scope: Scope
    ) -> list[Expr]:
        source = self.array(node.value, scope)
        if source is None or size_of(source.type) != size_of(target.type):
            raise ModelFormatError(
                f'{target.name} needs an array of the same size',
                scope.place(node.line),
                _MEND_SIZE,
            )
        if target.storage is Storage.CONSTANT or target.is_read_only:
            raise self._read_only(target.name, scope, node.line)
        result: list[Expr] = []
        for to, of in zip(self.elements(target), self.elements(source), strict=True):
            value = self.load(of, scope, node.line)
            result.append(self.assignment(to, value, scope, node.line))
        return result

    # -- references ----------------------------------------------------------------------
    def reference(self, node: syntax.Expression, scope: Scope) -> Reference:
        """Elaborate a name, array element or process variable."""
        if isinstance(node, syntax.Name):
            symbol = scope.find(node.name)
            if isinstance(symbol, Reference):
                return symbol
            raise self._not_a_variable(node.name, symbol, scope, node.line)
        if isinstance(node, syntax.Index):
            return self._indexed(node, scope)
        if isinstance(node, syntax.Member):
            process = self._process(node.owner, scope)
            symbol = process.scope.names.get(node.name)
            if isinstance(symbol, Reference):
                return symbol
            if isinstance(symbol, ValueSymbol) and isinstance(symbol.expr, Const):
                value = symbol.expr.low
                return Reference(node.name, Storage.CONSTANT, symbol.type, 0, 1, values=(value,))
            names = sorted({*process.locations, *process.scope.names})
            what = f'{_spelled(node.owner)} has no location or variable {node.name!r}'
            raise ModelFormatError(what, scope.place(node.line), suggestion(node.name, names))
        raise ModelFormatError(
            'only variables and array elements can stand here', scope.place(node.line), _MEND_NAME
        )

    def array(self, node: syntax.Expression, scope: Scope) -> Reference | None:
        """Return the reference if the expression names a whole array of integers."""
        if not isinstance(node, (syntax.Name, syntax.Index, syntax.Member)):
            return None
        if isinstance(node, syntax.Name) and not isinstance(scope.find(node.name), Reference):
            return None
        if isinstance(node, syntax.Member) and (
            node.name in self._process(node.owner, scope).locations
        ):
            return None
        found = self.reference(node, scope)
        is_array = isinstance(found.type, ArrayType)
        return found if is_array and isinstance(scalar_of(found.type), IntType) else None

    def elements(self, reference: Reference) -> list[Reference]:
        """Return the scalars of an array in order."""
        if not isinstance(reference.type, ArrayType):
            return [reference]
        parts = [self._part(reference, const(i)) for i in range(reference.type.length)]
        return [scalar for part in parts for scalar in self.elements(part)]

    def _part(self, reference: Reference, index: Expr) -> Reference:
        assert isinstance(reference.type, ArrayType)
        stride = const(size_of(reference.type.element))
        offset = binary(Op.ADD, reference.offset, binary(Op.MUL, index, stride))
        return Reference(
            reference.name,
            reference.storage,
            reference.type.element,
            reference.base,
            reference.length,
            offset,
            reference.values,
            reference.is_read_only,
        )

    def _indexed(self, node: syntax.Index, scope: Scope) -> Reference:
        array = self.reference(node.array, scope)
        if not isinstance(array.type, ArrayType):
            raise ModelFormatError(
                f'{array.name} is no array', scope.place(node.line), 'remove the index'
            )
        length, first = array.type.length, array.type.first
        last = first + length - 1
        what = f'index {{value}} is outside {array.name}, which has {length} elements'
        site = Site(scope.place(node.line), what, f'use {first}..{last}')
        value = self.pure(node.index, scope, 'an array index')
        index = self.tables.checked(value, first, last, site)
        return self._part(array, binary(Op.SUB, index, const(first)) if first else index)

    def _process(self, node: syntax.Expression, scope: Scope) -> ProcessSymbol:
        name = self._process_name(node, scope)
        symbol = scope.find(name)
        if isinstance(symbol, ProcessSymbol):
            return symbol
        known = sorted(n for n in scope.visible() if isinstance(scope.find(n), ProcessSymbol))
        what = f'there is no process {name!r}'
        raise ModelFormatError(what, scope.place(node.line), suggestion(name, known))

    def _process_name(self, node: syntax.Expression, scope: Scope) -> str:
        if isinstance(node, syntax.Call) and isinstance(node.function, syntax.Name):
            values = [str(self.constant(argument, scope)) for argument in node.arguments]
            return f'{node.function.name}({",".join(values)})'
        return _spelled(node)

    def _not_a_variable(
        self, name: str, symbol: object, scope: Scope, line: int
    ) -> ModelFormatError:
        place = scope.place(line)
        if name in RESERVED:
            return ModelFormatError(f'{name!r} is a keyword of UPPAAL', place, _MEND_NAME)
        if symbol is None:
            return ModelFormatError(
                f'{name!r} is not declared', place, suggestion(name, sorted(scope.visible()))
            )
        kind = {TypeSymbol: 'a type', ProcessSymbol: 'a process'}.get(type(symbol), 'a function')
        return ModelFormatError(f'{name!r} is {kind}, not a variable', place, _MEND_NAME)

    def _call(self, node: syntax.Call, scope: Scope) -> Expr:
        return self.calls.call(node, scope)


def _spelled(node: syntax.Expression) -> str:
    return node.name if isinstance(node, syntax.Name) else 'the expression'
