"""Makes syntax trees from the parser's reductions, bottom-up and without recursion."""

from __future__ import annotations

from typing import Any

from lark import Token, Transformer

from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.checker.uppaal.language.precedence import Operator, bounded, combine, height

Children = list[Any]
_EMPTY = syntax.Block((), (), 1)


def _of(children: Children, kind: type) -> tuple[Any, ...]:
    return tuple(child for child in children if isinstance(child, kind))


def _texts(children: Children, *terminals: str) -> tuple[str, ...]:
    return tuple(str(t) for t in children if isinstance(t, Token) and t.type in terminals)


def _line(token: Token) -> int:
    return token.line or 0


def _numbered(count: syntax.Expression) -> tuple[syntax.Expression, syntax.Expression]:
    """Return the bounds of ``count`` values numbered from 0."""
    zero, one = syntax.Number(count.line, 1, 0), syntax.Number(count.line, 1, 1)
    return zero, syntax.Binary(count.line, height(count, one), '-', count, one)


class TreeBuilder(Transformer):  # type: ignore[type-arg]
    """One method per rule of ``grammar.lark``; tokens that carry nothing are skipped."""

    # -- expressions ---------------------------------------------------------------------
    def expression(self, children: Children) -> syntax.Expression:
        items: list[syntax.Expression | Operator] = []
        for child in children:
            if isinstance(child, Token):
                expects_operand = not items or isinstance(items[-1], Operator)
                items.append(Operator(str(child), _line(child), is_prefix=expects_operand))
            else:
                items.append(child)
        return items[0] if len(items) == 1 else combine(items)  # type: ignore[return-value]

    def quantifier(self, children: Children) -> Operator:
        kind, variable, over = children
        head = (str(kind), str(variable), over)
        return Operator(str(kind), _line(kind), is_prefix=True, head=head)

    def choice(self, children: Children) -> Operator:
        return Operator('?', children[0].line, middle=children[0])

    def name(self, children: Children) -> syntax.Name:
        return syntax.Name(_line(children[0]), 1, str(children[0]))

    def number(self, children: Children) -> syntax.Number:
        token = children[0]
        if token.type == 'TRUTH':
            return syntax.Number(_line(token), 1, int(token == 'true'))
        # Values beyond 32 bits are refused later, with their place; the cut keeps int() cheap.
        return syntax.Number(_line(token), 1, int(token[:20]))

    def deadlock(self, children: Children) -> syntax.DeadlockAtom:
        return syntax.DeadlockAtom(_line(children[0]), 1)

    def index(self, children: Children) -> syntax.Index:
        array, index = children
        return syntax.Index(array.line, height(array, index), array, index)

    def call(self, children: Children) -> syntax.Call:
        function, arguments = children
        return syntax.Call(function.line, height(function, *arguments), function, arguments)

    def member(self, children: Children) -> syntax.Member:
        owner, name = children
        return syntax.Member(owner.line, height(owner), owner, str(name))

    def step(self, children: Children) -> syntax.Step:
        target, operator = children
        amount = 1 if operator == '++' else -1
        return syntax.Step(target.line, height(target), target, amount, False)

    def arguments(self, children: Children) -> tuple[syntax.Expression, ...]:
        return tuple(children)

    def expressions(self, children: Children) -> tuple[syntax.Expression, ...]:
        return tuple(children)

    # -- types and declarations ----------------------------------------------------------
    def range(self, children: Children) -> tuple[syntax.Expression, ...]:
        return tuple(children)

    def type_expression(self, children: Children) -> syntax.TypeExpression:
        bounds = _of(children, tuple)
        low, high = bounds[0] if bounds else (None, None)
        token = next(t for t in children if isinstance(t, Token) and t.type != 'PREFIX')
        if token.type == 'SCALAR':
            low, high = _numbered(children[-1])
        return syntax.TypeExpression(
            _line(token), _texts(children, 'PREFIX'), str(token), low, high
        )

    def array(self, children: Children) -> syntax.Dimension:
        if isinstance(children[0], Token):
            low, high = children[1]
            return syntax.TypeExpression(_line(children[0]), (), 'int', low, high)
        return children[0]  # type: ignore[no-any-return]

    def alias(self, children: Children) -> syntax.Declarator:
        name, *dimensions = children
        return syntax.Declarator(_line(name), str(name), tuple(dimensions))

    def declarator(self, children: Children) -> syntax.Declarator:
        name = children[0]
        initial = None
        if len(children) > 2 and isinstance(children[-2], Token):
            initial = children[-1]
            children = children[:-2]
        return syntax.Declarator(_line(name), str(name), tuple(children[1:]), initial)

    def initial(self, children: Children) -> syntax.Initial:
        return children[0]  # type: ignore[no-any-return]

    def initial_list(self, children: Children) -> syntax.Initial:
        return tuple(children)

    def variables(self, children: Children) -> syntax.Variables:
        return syntax.Variables(children[0], tuple(children[1:]))

    def typedef(self, children: Children) -> syntax.Typedef:
        return syntax.Typedef(children[1], tuple(children[2:]))

    def parameter(self, children: Children) -> syntax.Parameter:
        names = [t for t in children if isinstance(t, Token) and t.type == 'ID']
        after = children[children.index(names[0]) + 1 :]
        is_reference = bool(_texts(children, 'AMPERSAND'))
        return syntax.Parameter(
            children[0], is_reference, str(names[0]), tuple(after), _line(names[0])
        )

    def parameters(self, children: Children) -> list[syntax.Parameter]:
        return children

    def select(self, children: Children) -> syntax.Select:
        return syntax.Select(str(children[0]), children[1], _line(children[0]))

    def function(self, children: Children) -> syntax.Function:
        over, name, parameters, body = children
        return syntax.Function(over, str(name), tuple(parameters), body, _line(name))

    def instantiation(self, children: Children) -> syntax.Instantiation:
        names = [t for t in children if isinstance(t, Token) and t.type == 'ID']
        lists = [child for child in children if isinstance(child, list)]
        parameters = tuple(lists[0]) if lists else ()
        return syntax.Instantiation(
            str(names[0]), parameters, str(names[1]), children[-1], _line(names[0])
        )

    def system_line(self, children: Children) -> syntax.SystemLine:
        return syntax.SystemLine(tuple((str(name), _line(name)) for name in children[1:]))

    # -- statements ----------------------------------------------------------------------
    def empty(self, children: Children) -> syntax.Block:
        return _EMPTY

    def block(self, children: Children) -> syntax.Block:
        declarations = tuple(
            c for c in children if isinstance(c, (syntax.Variables, syntax.Typedef))
        )
        statements = tuple(children[len(declarations) :])
        return syntax.Block(declarations, statements, _statement_depth(*statements))

    def expression_statement(self, children: Children) -> syntax.ExpressionStatement:
        return syntax.ExpressionStatement(children[0])

    def branch(self, children: Children) -> syntax.Branch:
        parts = [child for child in children if not isinstance(child, Token)]
        otherwise = parts[2] if len(parts) > 2 else None
        return syntax.Branch(parts[0], parts[1], otherwise, _statement_depth(*parts[1:]))

    def while_loop(self, children: Children) -> syntax.Loop:
        _, condition, body = children
        return syntax.Loop((), condition, (), body, True, _statement_depth(body))

    def do_loop(self, children: Children) -> syntax.Loop:
        _, body, _, condition = children
        return syntax.Loop((), condition, (), body, False, _statement_depth(body))

    def for_loop(self, children: Children) -> syntax.Loop:
        _, start, condition, steps, body = children
        return syntax.Loop(start, condition, steps, body, True, _statement_depth(body))

    def loop_condition(self, children: Children) -> syntax.Expression | None:
        return children[0] if children else None

    def iteration(self, children: Children) -> syntax.Iteration:
        _, variable, over, body = children
        return syntax.Iteration(str(variable), over, body, _statement_depth(body))

    def return_statement(self, children: Children) -> syntax.Return:
        value = children[1] if len(children) > 1 else None
        return syntax.Return(value, _line(children[0]))

    # -- whole texts ---------------------------------------------------------------------
    def declarations(self, children: Children) -> tuple[syntax.Declaration, ...]:
        return tuple(children)

    def system(self, children: Children) -> tuple[syntax.Declaration, ...]:
        return tuple(children)

    def selects(self, children: Children) -> tuple[syntax.Select, ...]:
        return tuple(children)

    def updates(self, children: Children) -> tuple[syntax.Expression, ...]:
        return tuple(children)

    def condition(self, children: Children) -> syntax.Expression:
        return children[0]  # type: ignore[no-any-return]

    def query(self, children: Children) -> syntax.Query:
        operator = next(t for t in children if isinstance(t, Token))
        operands = _of(children, syntax.Expression)
        text = ''.join(str(operator).split())
        return syntax.Query(text, operands, operands[0].line)


def _statement_depth(*statements: syntax.Statement) -> int:
    depths = [getattr(statement, 'depth', 1) for statement in statements]
    return bounded(max(depths, default=0) + 1, 0)
