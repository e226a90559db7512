"""
Python source for the expressions, functions and updates of a network.

The code works on packed states (``state_layout.py``): the state is the integer ``s``, which
updates bind anew. Evaluation order is that of ``interpreter.py``. Masks are as long as a state,
and written in hexadecimal digits: of decimal ones Python reads and writes no more than 4300.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ros2cc_extract.checker.engines.state_layout import Field, Layout
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
    Stmt,
    Table,
    Unary,
    Var,
)
from ros2cc_extract.checker.network.traversal import (
    calls_of,
    function_expressions,
    has_effect,
    has_passes,
    walk,
)

_SIMPLE = {
    Op.ADD: '+', Op.SUB: '-', Op.MUL: '*', Op.SHL: '<<', Op.SHR: '>>', Op.BIT_AND: '&',
    Op.BIT_OR: '|', Op.BIT_XOR: '^', Op.EQ: '==', Op.NE: '!=', Op.LT: '<', Op.LE: '<=',
    Op.GT: '>', Op.GE: '>=', Op.AND: 'and', Op.OR: 'or',
}  # fmt: skip
_CALLS = {Op.MIN: 'min', Op.MAX: 'max', Op.DIV: '_quotient', Op.MOD: '_remainder'}
INDENT = '    '


class SourceWriter:
    """
    Writes source for one network.

    :param is_inside: whether the source is for the body of a function; a call from outside
        starts the count of loop passes anew.
    """

    def __init__(self, network: Network, layout: Layout) -> None:
        self._network = network
        self._layout = layout
        self._called = {called for f in network.functions for called in calls_of(f)}
        self._frame_is_list = False
        self._is_inside = False
        self._writes = False
        self.tables: dict[tuple[int, ...], str] = {}
        self._handlers: dict[type, Callable[[Any], str]] = {
            Const: lambda node: str(node.low),
            Var: self._var,
            Element: self._element,
            Table: self._table,
            Local: self._local,
            LocalElement: lambda node: f'L[{node.base} + {self.value(node.index)}]',
            Unary: self._unary,
            Binary: self._binary,
            Choice: self._choice,
            Check: self._check,
            Call: self._call,
            Assign: self._assign_value,
            AtLocation: self._at_location,
            DeadlockAtom: lambda node: 'dead',
        }

    # -- expressions ---------------------------------------------------------------------
    def value(self, expr: Expr) -> str:
        """Return an expression, safe to stand next to any operator."""
        return self._handlers[type(expr)](expr)

    def _read(self, field: Field, shift: str) -> str:
        read = f's >> {shift} & {field.ones}' if shift != '0' else f's & {field.ones}'
        return f'(({read}) + {field.low})' if field.low else f'({read})'

    def _var(self, node: Var) -> str:
        field = self._layout.variables[node.slot]
        return self._read(field, str(field.shift))

    def _element(self, node: Element) -> str:
        field = self._layout.variables[node.base]
        return self._read(field, self._element_shift(node))

    def _element_shift(self, node: Element) -> str:
        field = self._layout.variables[node.base]
        return f'{field.shift} + {field.width} * {self.value(node.index)}'

    def _table(self, node: Table) -> str:
        """Each table has a name of its own, in ``tables``: one is read at many places."""
        name = self.tables.setdefault(node.values, f'_table{len(self.tables)}')
        return f'{name}[{self.value(node.index)}]'

    def _local(self, node: Local) -> str:
        return f'L[{node.slot}]' if self._frame_is_list else f'l{node.slot}'

    def _unary(self, node: Unary) -> str:
        word = 'not' if node.op is Op.NOT else '-'
        return f'({word} {self.value(node.operand)})'

    def _binary(self, node: Binary) -> str:
        if node.op is Op.EQ and isinstance(node.left, Var) and isinstance(node.right, Const):
            field = self._layout.variables[node.left.slot]
            if 0 <= node.right.low - field.low <= field.ones:
                return f'(s & {field.mask:#x} == {node.right.low - field.low << field.shift:#x})'
        left, right = self.value(node.left), self.value(node.right)
        if node.op in _CALLS:
            return f'{_CALLS[node.op]}({left}, {right})'
        return f'({left} {_SIMPLE[node.op]} {right})'

    def _choice(self, node: Choice) -> str:
        condition = self.value(node.condition)
        return f'({self.value(node.then)} if {condition} else {self.value(node.otherwise)})'

    def _check(self, node: Check) -> str:
        operand = self.value(node.operand)
        if node.is_zero_bad:
            return f'((_c := {operand}) or _fail({node.site}, 0))'
        test = f'{node.low} <= (_c := {operand}) <= {node.high}'
        return f'(_c if {test} else _fail({node.site}, _c))'

    def _call(self, node: Call) -> str:
        prefix = '_f' if self._is_inside else '_o'
        arguments = ''.join(f', {self.value(argument)}' for argument in node.arguments)
        call = f'{prefix}{node.function}(s{arguments})'
        if self._network.functions[node.function].writes:
            return f'((_t := {call}), (s := _t[0]), _t[1])[2]'
        return call

    def _at_location(self, node: AtLocation) -> str:
        field = self._layout.locations[node.process]
        return f'(s & {field.mask:#x} == {node.location << field.shift:#x})'

    # -- assignments ---------------------------------------------------------------------
    def _stored(self, field: Field, value: str) -> str:
        return f'({value} - {field.low})' if field.low else value

    def _new_state(self, target: Var | Element, value: str) -> str:
        """Return the state after writing ``value``, which must not change ``s``."""
        if isinstance(target, Var):
            field = self._layout.variables[target.slot]
            return f's & {~field.mask:#x} | {self._stored(field, value)} << {field.shift}'
        field = self._layout.variables[target.base]
        shift = self._element_shift(target)
        stored = self._stored(field, value)
        return f's & ~({field.ones} << (_k := {shift})) | {stored} << _k'

    def _assign_value(self, node: Assign) -> str:
        value, target = self.value(node.value), node.target
        if isinstance(target, (Var, Element)):
            return f'((_v := {value}), (s := {self._new_state(target, "_v")}), _v)[2]'
        if isinstance(target, Local) and not self._frame_is_list:
            return f'(l{target.slot} := {value})'
        return f'((_v := {value}), L.__setitem__({self._cell(target)}, _v), _v)[2]'

    def _cell(self, target: Local | LocalElement) -> str:
        if isinstance(target, Local):
            return str(target.slot)
        return f'{target.base} + {self.value(target.index)}'

    def effect(self, expr: Expr, indent: str) -> list[str]:
        """Return statements that evaluate an expression for its effect."""
        if not isinstance(expr, Assign):
            return [f'{indent}{self.value(expr)}']
        target = expr.target
        if not isinstance(target, (Var, Element)):
            if isinstance(target, Local) and not self._frame_is_list:
                return [f'{indent}l{target.slot} = {self.value(expr.value)}']
            lines = [f'{indent}_v = {self.value(expr.value)}']
            return [*lines, f'{indent}L[{self._cell(target)}] = _v']
        value = self.value(expr.value)
        lines = []
        if has_effect(expr.value, self._network.functions):
            # The old state must be read after the value has changed it.
            lines.append(f'{indent}_v = {value}')
            value = '_v'
        return [*lines, f'{indent}s = {self._new_state(target, value)}']

    def updates(self, updates: Sequence[Expr], indent: str) -> list[str]:
        """Return the statements of an edge's updates."""
        return [line for update in updates for line in self.effect(update, indent)]

    # -- functions -----------------------------------------------------------------------
    def function(self, number: int) -> list[str]:
        """Return the definitions ``_fN`` and ``_oN`` of a function."""
        function = self._network.functions[number]
        self._frame_is_list = any(
            isinstance(node, LocalElement)
            for expr in function_expressions(function.body)
            for node in walk(expr)
        )
        self._is_inside, self._writes = True, function.writes
        lines = [f'def _f{number}(s{_parameters(function)}):', *self._frame(function)]
        is_called = number in self._called
        lines += self._count(1, INDENT, number) if is_called else []
        lines += self._statements(function.body, INDENT, number)
        lines.append(f'{INDENT}return {"s, 0" if function.writes else 0}')
        self._frame_is_list = self._is_inside = False
        if not is_called and not has_passes(function):
            return [*lines, f'_o{number} = _f{number}']
        return [
            *lines,
            f'def _o{number}(*arguments):',
            # The outermost call counts itself, but is not inside another.
            f'{INDENT}_passes[0] = {MAX_LOOP_STEPS + is_called}',
            f'{INDENT}return _f{number}(*arguments)',
        ]

    def _frame(self, function: Function) -> list[str]:
        given, rest = function.parameters, function.frame - function.parameters
        if self._frame_is_list:
            arguments = ''.join(f'l{slot}, ' for slot in range(given))
            return [f'{INDENT}L = [{arguments}{"0, " * rest}]']
        return [f'{INDENT}l{given + slot} = 0' for slot in range(rest)]

    def _statements(self, body: Sequence[Stmt], indent: str, number: int) -> list[str]:
        lines = [line for node in body for line in self._statement(node, indent, number)]
        return lines or [f'{indent}pass']

    def _statement(self, node: Stmt, indent: str, number: int) -> list[str]:
        deeper = indent + INDENT
        if isinstance(node, Evaluate):
            return self.effect(node.expr, indent)
        if isinstance(node, Return):
            return self._return(node, indent)
        if isinstance(node, If):
            lines = [f'{indent}if {self.value(node.condition)}:']
            lines += self._statements(node.then, deeper, number)
            if node.otherwise:
                lines += [f'{indent}else:', *self._statements(node.otherwise, deeper, number)]
            return lines
        if isinstance(node, ForRange):
            count = node.high - node.low + 1
            name = self._local(Local(0, 0, node.slot))
            lines = self._count(count, indent, number)
            lines.append(f'{indent}for {name} in range({node.low}, {node.high + 1}):')
            return lines + self._statements(node.body, deeper, number)
        lines = [f'{indent}while {self.value(node.condition)}:']
        return lines + self._count(1, deeper, number) + self._statements(node.body, deeper, number)

    def _return(self, node: Return, indent: str) -> list[str]:
        value = self.value(node.value) if node.value else '0'
        if self._writes:
            return [f'{indent}_r = {value}', f'{indent}return s, _r']
        return [f'{indent}return {value}']

    def _count(self, passes: int, indent: str, number: int) -> list[str]:
        return [
            f'{indent}_passes[0] -= {passes}',
            f'{indent}if _passes[0] < 0: _endless({number})',
        ]


def _parameters(function: Function) -> str:
    return ''.join(f', l{slot}' for slot in range(function.parameters))
