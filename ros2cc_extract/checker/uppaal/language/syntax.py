"""Syntax trees of the UPPAAL language; lines are lines of the model file."""

from __future__ import annotations

from ros2cc_extract.light_dataclasses import dataclass


@dataclass(frozen=True)
class Expression:
    """
    Base of all expressions.

    :param depth: height of the tree, bounded by the parser so that recursion over it is safe.
    """

    line: int
    depth: int


@dataclass(frozen=True)
class Name(Expression):
    """A bare identifier."""

    name: str


@dataclass(frozen=True)
class Number(Expression):
    """A literal; ``true`` is 1."""

    value: int


@dataclass(frozen=True)
class DeadlockAtom(Expression):
    """The state formula ``deadlock``."""


@dataclass(frozen=True)
class Index(Expression):
    """``array[index]``."""

    array: Expression
    index: Expression


@dataclass(frozen=True)
class Call(Expression):
    """``function(arguments)``; in queries also a process ``Template(arguments)``."""

    function: Expression
    arguments: tuple[Expression, ...]


@dataclass(frozen=True)
class Member(Expression):
    """``process.name``."""

    owner: Expression
    name: str


@dataclass(frozen=True)
class Unary(Expression):
    """Prefix ``!``, ``not``, ``+`` or ``-``."""

    operator: str
    operand: Expression


@dataclass(frozen=True)
class Binary(Expression):
    """Infix operators but the assignments."""

    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True)
class Conditional(Expression):
    """``condition ? then : otherwise``."""

    condition: Expression
    then: Expression
    otherwise: Expression


@dataclass(frozen=True)
class Assign(Expression):
    """``target operator= value``; ``operator`` is empty for the plain assignment."""

    operator: str
    target: Expression
    value: Expression


@dataclass(frozen=True)
class Step(Expression):
    """``x++`` and its three relatives; ``amount`` is +1 or -1."""

    target: Expression
    amount: int
    is_prefix: bool


@dataclass(frozen=True)
class Quantifier(Expression):
    """``forall``, ``exists`` and ``sum``."""

    kind: str
    variable: str
    type: TypeExpression
    body: Expression


@dataclass(frozen=True)
class TypeExpression:
    """A type as written: ``prefixes base[low, high]``."""

    line: int
    prefixes: tuple[str, ...]
    base: str
    low: Expression | None = None
    high: Expression | None = None


Dimension = Expression | TypeExpression
Initial = Expression | tuple['Initial', ...]


@dataclass(frozen=True)
class Declarator:
    """One name of a declaration, with its array dimensions and initialiser."""

    line: int
    name: str
    dimensions: tuple[Dimension, ...]
    initial: Initial | None = None


@dataclass(frozen=True)
class Variables:
    """``type declarator, …;``"""

    type: TypeExpression
    declarators: tuple[Declarator, ...]


@dataclass(frozen=True)
class Typedef:
    """``typedef type name, …;``"""

    type: TypeExpression
    aliases: tuple[Declarator, ...]


@dataclass(frozen=True)
class Parameter:
    """A parameter of a template or function."""

    type: TypeExpression
    is_reference: bool
    name: str
    dimensions: tuple[Dimension, ...]
    line: int


@dataclass(frozen=True)
class Select:
    """``name : type`` on an edge."""

    name: str
    type: TypeExpression
    line: int


@dataclass(frozen=True)
class Function:
    """A function with its body."""

    type: TypeExpression
    name: str
    parameters: tuple[Parameter, ...]
    body: Block
    line: int


@dataclass(frozen=True)
class Instantiation:
    """``name(parameters) = template(arguments);``"""

    name: str
    parameters: tuple[Parameter, ...]
    template: str
    arguments: tuple[Expression, ...]
    line: int


@dataclass(frozen=True)
class SystemLine:
    """``system name, …;``"""

    names: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Query:
    """``A[]``, ``E<>``, ``A<>``, ``E[]`` with one operand, ``-->`` with two."""

    operator: str
    operands: tuple[Expression, ...]
    line: int


@dataclass(frozen=True)
class Block:
    """``{ declarations statements }``; an own scope."""

    declarations: tuple[Variables | Typedef, ...]
    statements: tuple[Statement, ...]
    depth: int


@dataclass(frozen=True)
class ExpressionStatement:
    """``expression;``"""

    expression: Expression


@dataclass(frozen=True)
class Branch:
    """``if (condition) then else otherwise``."""

    condition: Expression
    then: Statement
    otherwise: Statement | None
    depth: int


@dataclass(frozen=True)
class Loop:
    """All loops but the iteration; ``tests_first`` is false for ``do … while``."""

    start: tuple[Expression, ...]
    condition: Expression | None
    steps: tuple[Expression, ...]
    body: Statement
    tests_first: bool
    depth: int


@dataclass(frozen=True)
class Iteration:
    """``for (variable : type) body``."""

    variable: str
    type: TypeExpression
    body: Statement
    depth: int


@dataclass(frozen=True)
class Return:
    """``return value;``"""

    value: Expression | None
    line: int


Statement = Block | ExpressionStatement | Branch | Loop | Iteration | Return
Declaration = Variables | Typedef | Function | Instantiation | SystemLine
