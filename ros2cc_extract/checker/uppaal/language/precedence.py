"""
Operator precedence: a flat list of operands and operators becomes one tree.

Order of the operators: that of UPPAAL 4.1 and 5 (documentation, page "Expressions", section on
precedence; the parser library utap from 0.92 on): ``not`` is ``!``, ``and`` is ``&&``, and ``or``,
``xor`` and ``imply`` bind like ``||``. UPPAAL 4.0 had the words weaker than the assignments.
Works without recursion.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence

from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.light_dataclasses import dataclass

MAX_DEPTH = 100


@dataclass(frozen=True)
class Operator:
    """
    A prefix or infix operator on its way into the tree.

    :param middle: the operand between ``?`` and ``:``; the quantifier's head is in ``head``.
    """

    text: str
    line: int
    is_prefix: bool = False
    middle: syntax.Expression | None = None
    head: tuple[str, str, syntax.TypeExpression] | None = None


_ASSIGNMENTS = ('=', ':=', '+=', '-=', '*=', '/=', '%=', '&=', '|=', '^=', '<<=', '>>=')
_LEVELS: tuple[tuple[str, ...], ...] = (
    _ASSIGNMENTS,
    ('?',),
    ('||', 'or', 'xor', 'imply'),
    ('&&', 'and'),
    ('|',),
    ('^',),
    ('&',),
    ('==', '!='),
    ('<', '<=', '>=', '>'),
    ('<?', '>?'),
    ('<<', '>>'),
    ('+', '-'),
    ('*', '/', '%'),
)
_INFIX = {text: level for level, texts in enumerate(_LEVELS, 1) for text in texts}
_RIGHT_ASSOCIATIVE = {_INFIX['='], _INFIX['?']}
_PREFIX = {'forall': 0, 'exists': 0, 'sum': 0}
_TIGHT_PREFIX = len(_LEVELS) + 1
_CHAINED = ('&&', '||', 'and', 'or')
_SPELLING = {'and': '&&', 'or': '||', 'not': '!'}


class NestingError(Exception):
    """A tree higher than ``MAX_DEPTH``; carries the line."""

    def __init__(self, line: int) -> None:
        super().__init__(line)
        self.line = line


def bounded(depth: int, line: int) -> int:
    """Return ``depth``, or raise when no recursive pass could follow."""
    if depth > MAX_DEPTH:
        raise NestingError(line)
    return depth


def height(*children: syntax.Expression) -> int:
    """Return the depth of a node over ``children``, refusing what is too deep."""
    return bounded(max(child.depth for child in children) + 1, children[0].line)


def combine(items: Sequence[syntax.Expression | Operator]) -> syntax.Expression:
    """Order ``prefix* operand (infix prefix* operand)*`` by precedence."""
    operands: list[syntax.Expression] = []
    waiting: list[Operator] = []
    for item in items:
        if isinstance(item, syntax.Expression):
            operands.append(item)
        elif item.is_prefix:
            waiting.append(item)
        else:
            _reduce_while(operands, waiting, functools.partial(_binds_first, new=item))
            waiting.append(item)
    _reduce_while(operands, waiting, lambda top: True)
    return operands[0]


def _level(operator: Operator) -> int:
    if operator.is_prefix:
        return _PREFIX.get(operator.text, _TIGHT_PREFIX)
    return _INFIX[operator.text]


def _binds_first(top: Operator, *, new: Operator) -> bool:
    if _level(top) == _level(new):
        is_chain = top.text == new.text and new.text in _CHAINED
        return not is_chain and _level(new) not in _RIGHT_ASSOCIATIVE
    return _level(top) > _level(new)


def _reduce_while(
    operands: list[syntax.Expression],
    waiting: list[Operator],
    condition: Callable[[Operator], bool],
) -> None:
    while waiting and condition(waiting[-1]):
        operator = waiting.pop()
        right = operands.pop()
        if operator.is_prefix:
            operands.append(_prefixed(operator, right))
            continue
        terms = [right, operands.pop()]
        # A chain of one associative operator becomes a balanced tree, so that generated guards
        # with hundreds of conjuncts stay shallow.
        while operator.text in _CHAINED and waiting and waiting[-1].text == operator.text:
            waiting.pop()
            terms.append(operands.pop())
        operands.append(_balanced(operator, terms[::-1]))


def _balanced(operator: Operator, terms: list[syntax.Expression]) -> syntax.Expression:
    while len(terms) > 1:
        pairs = [_infixed(operator, terms[i], terms[i + 1]) for i in range(0, len(terms) - 1, 2)]
        terms = pairs + terms[len(terms) - len(terms) % 2 :]
    return terms[0]


def _prefixed(operator: Operator, operand: syntax.Expression) -> syntax.Expression:
    depth = bounded(operand.depth + 1, operator.line)
    if operator.head:
        kind, variable, over = operator.head
        return syntax.Quantifier(operator.line, depth, kind, variable, over, operand)
    if operator.text in ('++', '--'):
        amount = 1 if operator.text == '++' else -1
        return syntax.Step(operator.line, depth, operand, amount, True)
    text = _SPELLING.get(operator.text, operator.text)
    return syntax.Unary(operator.line, depth, text, operand)


def _infixed(
    operator: Operator, left: syntax.Expression, right: syntax.Expression
) -> syntax.Expression:
    line = left.line
    if operator.middle:
        depth = height(left, operator.middle, right)
        return syntax.Conditional(line, depth, left, operator.middle, right)
    depth = height(left, right)
    if operator.text in _ASSIGNMENTS:
        compound = '' if operator.text == ':=' else operator.text[:-1]
        return syntax.Assign(line, depth, compound, left, right)
    text = _SPELLING.get(operator.text, operator.text)
    return syntax.Binary(line, depth, text, left, right)
