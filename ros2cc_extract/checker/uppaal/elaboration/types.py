"""Types, references to storage, and the scopes in which names stand for them."""

from __future__ import annotations

import difflib
from dataclasses import field
from enum import Enum

from ros2cc_extract.checker.network.network import Const, Expr
from ros2cc_extract.checker.uppaal.language import syntax
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

#: Range of a plain ``int``. Source: UPPAAL documentation, page "Types".
INT16 = (-32768, 32767)
_KEYWORDS = (
    'chan clock bool int commit const urgent broadcast init process state guard sync assign '
    'system trans deadlock and or not imply true false for while do if else return typedef '
    'struct rate before_update after_update meta priority progress scalar select void '
    'default forall exists sum hybrid double string switch case continue break enum'
)
RESERVED = frozenset(_KEYWORDS.split())


@dataclass(frozen=True)
class IntType:
    """Integers ``low..high``; ``is_bool`` converts by comparing with zero."""

    low: int
    high: int
    is_bool: bool = False


@dataclass(frozen=True)
class ArrayType:
    """``length`` elements, numbered from ``first``."""

    element: Type
    length: int
    first: int = 0


@dataclass(frozen=True)
class ChannelType:
    """A channel."""

    is_broadcast: bool
    is_urgent: bool


Type = IntType | ArrayType | ChannelType
BOOL = IntType(0, 1, is_bool=True)


def size_of(declared: Type) -> int:
    """Return the number of scalars in a value of the type."""
    if isinstance(declared, ArrayType):
        return declared.length * size_of(declared.element)
    return 1


def scalar_of(declared: Type) -> IntType | ChannelType:
    """Return the type of the innermost elements."""
    while isinstance(declared, ArrayType):
        declared = declared.element
    return declared


def default_value(declared: IntType) -> int:
    """Return what a variable without initialiser starts with: 0, or the nearest in range."""
    return min(max(0, declared.low), declared.high)


class Storage(Enum):
    """Where a referenced value lives."""

    STATE = 'state'
    LOCAL = 'local'
    CONSTANT = 'constant'
    CHANNEL = 'channel'


@dataclass(frozen=True)
class Reference:
    """
    A variable, constant or channel, or a part of one.

    :param base: first slot of the whole object; ``length`` counts its slots.
    :param offset: slots from ``base`` to the part, within ``length``.
    :param values: of constants, one per slot.
    """

    name: str
    storage: Storage
    type: Type
    base: int
    length: int
    offset: Expr = Const(0, 0)
    values: tuple[int, ...] = ()
    is_read_only: bool = False


@dataclass(frozen=True)
class ValueSymbol:
    """A name that stands for an expression: an inlined argument."""

    type: IntType
    expr: Expr


@dataclass(frozen=True)
class TypeSymbol:
    """A typedef."""

    type: Type


@dataclass(frozen=True, eq=False)
class FunctionSymbol:
    """A function and the scope it was declared in."""

    function: syntax.Function
    scope: Scope


@dataclass(frozen=True, eq=False)
class ProcessSymbol:
    """A process, for queries: its locations by name and the scope of its declarations."""

    index: int
    locations: dict[str, int]
    scope: Scope


Symbol = Reference | ValueSymbol | TypeSymbol | FunctionSymbol | ProcessSymbol


@dataclass(eq=False)
class Scope:
    """Names of one block, process or file; inner scopes hide outer ones."""

    file: str
    outer: Scope | None = None
    names: dict[str, Symbol] = field(default_factory=dict)

    def inner(self) -> Scope:
        """Return a new scope inside this one."""
        return Scope(self.file, self)

    def place(self, line: int) -> Place:
        """Return the place of a line of this file."""
        return Place(self.file, line)

    def declare(self, name: str, symbol: Symbol, line: int) -> None:
        """Add a name; a second declaration in the same scope is an error."""
        if name in RESERVED:
            what = f'{name!r} is a keyword of UPPAAL and cannot be a name'
            raise ModelFormatError(what, self.place(line), 'choose another name')
        if name in self.names:
            what = f'{name!r} is declared twice'
            raise ModelFormatError(what, self.place(line), 'rename one of the two')
        self.names[name] = symbol

    def find(self, name: str) -> Symbol | None:
        """Look a name up, from the inside out."""
        scope: Scope | None = self
        while scope is not None:
            if name in scope.names:
                return scope.names[name]
            scope = scope.outer
        return None

    def visible(self) -> set[str]:
        """Return all names that can be used here."""
        return set(self.names) | (self.outer.visible() if self.outer else set())


def suggestion(name: str, known: list[str]) -> str:
    """Return how to mend a name that is not known."""
    close = difflib.get_close_matches(name, known, n=1)
    if close:
        return f'did you mean {close[0]!r}?'
    return 'known are ' + ', '.join(known[:8]) if known else 'declare it first'
