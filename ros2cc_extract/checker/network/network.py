"""
The network: processes over integer tables, what every engine explores.

Owns the shape of an elaborated model. Knows neither XML nor how states are searched. All
expressions carry the interval their value lies in, so that run-time range checks exist only
where they can fail; arithmetic never leaves 32 bits unchecked.
"""

from __future__ import annotations

from enum import Enum

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

INT32 = (-(2**31), 2**31 - 1)
#: Loop passes, and calls inside it, in one call of a function from an edge or query, after which
#: it counts as endless.
MAX_LOOP_STEPS = 1_000_000


class Op(Enum):
    """Operators; the value is the UPPAAL spelling."""

    NEG = '-x'
    NOT = '!'
    ADD = '+'
    SUB = '-'
    MUL = '*'
    DIV = '/'
    MOD = '%'
    SHL = '<<'
    SHR = '>>'
    BIT_AND = '&'
    BIT_OR = '|'
    BIT_XOR = '^'
    MIN = '<?'
    MAX = '>?'
    EQ = '=='
    NE = '!='
    LT = '<'
    LE = '<='
    GT = '>'
    GE = '>='
    AND = '&&'
    OR = '||'


@dataclass(frozen=True)
class Expr:
    """Base of expressions; the value lies in ``low..high``."""

    low: int
    high: int


@dataclass(frozen=True)
class Const(Expr):
    """The value ``low``."""


@dataclass(frozen=True)
class Var(Expr):
    """The state variable ``slot``."""

    slot: int


@dataclass(frozen=True)
class Element(Expr):
    """The state variable ``base + index``, with ``index`` in ``0..length-1``."""

    base: int
    length: int
    index: Expr


@dataclass(frozen=True)
class Table(Expr):
    """The constant ``values[index]``."""

    values: tuple[int, ...]
    index: Expr


@dataclass(frozen=True)
class Local(Expr):
    """The function's local ``slot``."""

    slot: int


@dataclass(frozen=True)
class LocalElement(Expr):
    """The function's local ``base + index``."""

    base: int
    length: int
    index: Expr


@dataclass(frozen=True)
class Unary(Expr):
    """``NEG`` or ``NOT``."""

    op: Op
    operand: Expr


@dataclass(frozen=True)
class Binary(Expr):
    """``AND`` and ``OR`` are lazy and 0 or 1; ``DIV`` and ``MOD`` truncate towards zero."""

    op: Op
    left: Expr
    right: Expr


@dataclass(frozen=True)
class Choice(Expr):
    """``condition ? then : otherwise``."""

    condition: Expr
    then: Expr
    otherwise: Expr


@dataclass(frozen=True)
class Check(Expr):
    """
    The value of ``operand``, or the error ``site`` when it is outside ``low..high``.

    :param is_zero_bad: refuses only zero (divisors).
    """

    operand: Expr
    site: int
    is_zero_bad: bool = False


@dataclass(frozen=True)
class Call(Expr):
    """The value of a function."""

    function: int
    arguments: tuple[Expr, ...]


Target = Var | Element | Local | LocalElement


@dataclass(frozen=True)
class Assign(Expr):
    """Writes ``value`` (in the target's range) and is that value."""

    target: Target
    value: Expr


@dataclass(frozen=True)
class AtLocation(Expr):
    """Whether a process is in a location."""

    process: int
    location: int


@dataclass(frozen=True)
class DeadlockAtom(Expr):
    """Whether the state has no successor."""


@dataclass(frozen=True)
class Evaluate:
    """Evaluate for the effect."""

    expr: Expr


@dataclass(frozen=True)
class If:
    """A branch."""

    condition: Expr
    then: tuple[Stmt, ...]
    otherwise: tuple[Stmt, ...]


@dataclass(frozen=True)
class While:
    """A loop; each pass counts against ``MAX_LOOP_STEPS``."""

    condition: Expr
    body: tuple[Stmt, ...]


@dataclass(frozen=True)
class ForRange:
    """A loop over ``low..high``, all of whose passes count at its start."""

    slot: int
    low: int
    high: int
    body: tuple[Stmt, ...]


@dataclass(frozen=True)
class Return:
    """Leave the function; ``value`` is ``None`` in void functions."""

    value: Expr | None


Stmt = Evaluate | If | While | ForRange | Return


@dataclass(frozen=True)
class Site:
    """Where a check fails, and what it then says; ``{value}`` stands for the value."""

    place: Place
    what: str
    mend: str


@dataclass(frozen=True)
class Function:
    """
    A function.

    :param frame: number of local slots; the first ``parameters`` hold the arguments, the others 0.
    :param writes: whether it, or what it calls, assigns state variables.
    """

    name: str
    parameters: int
    frame: int
    body: tuple[Stmt, ...]
    writes: bool
    place: Place


@dataclass(frozen=True)
class Variable:
    """A scalar of the state; ``name`` as in ``executor.ready[2]``."""

    name: str
    low: int
    high: int
    initial: int


@dataclass(frozen=True)
class Channel:
    """A channel; elements of channel arrays are channels."""

    name: str
    is_broadcast: bool
    is_urgent: bool


class Direction(Enum):
    """Which end of a synchronisation."""

    SEND = '!'
    RECEIVE = '?'


@dataclass(frozen=True)
class Sync:
    """The channel ``base + index``, one of ``base..base+length-1``."""

    direction: Direction
    base: int
    length: int
    index: Expr


@dataclass(frozen=True)
class Location:
    """A location of a process."""

    name: str
    is_urgent: bool
    is_committed: bool


@dataclass(frozen=True)
class Edge:
    """An edge of a process, for one choice of its select values."""

    source: int
    target: int
    guard: Expr | None
    sync: Sync | None
    updates: tuple[Expr, ...]
    select: tuple[tuple[str, int], ...]
    comment: str
    place: Place


@dataclass(frozen=True)
class Process:
    """
    An instance of a template.

    :param arguments: values of the template's value parameters, in order.
    """

    name: str
    template: str
    arguments: tuple[int, ...]
    locations: tuple[Location, ...]
    initial: int
    edges: tuple[Edge, ...]

    def leaving(self) -> list[list[tuple[int, Edge]]]:
        """Return the edges that leave each location, with their numbers."""
        leaving: list[list[tuple[int, Edge]]] = [[] for _ in self.locations]
        for number, edge in enumerate(self.edges):
            leaving[edge.source].append((number, edge))
        return leaving


@dataclass(frozen=True)
class Network:
    """
    A model without names to look up: everything an engine needs.

    A state is one location per process, then one value per variable.
    """

    processes: tuple[Process, ...]
    variables: tuple[Variable, ...]
    channels: tuple[Channel, ...]
    functions: tuple[Function, ...]
    sites: tuple[Site, ...]


class QueryKind(Enum):
    """The five path formulae; the value is the UPPAAL spelling."""

    INVARIANT = 'A[]'
    REACHABLE = 'E<>'
    EVENTUALLY = 'A<>'
    POSSIBLY_ALWAYS = 'E[]'
    LEADS_TO = '-->'


@dataclass(frozen=True)
class Property:
    """An elaborated query; ``premise`` only for leads-to."""

    kind: QueryKind
    formula: Expr
    premise: Expr | None = None
