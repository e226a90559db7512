"""
The abstract values of a program's set-up phase: what an expression may stand for.

Mutable values keep what can change in ``slots``, which only ``store.py`` writes, so that two
branches can be tried one after the other from the same state. Nothing here knows ROS.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import field
from itertools import count
from typing import Any

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown

_TEXT_LIMIT = 60

NO_CALLER = 'no caller is known'
NOT_FOLDED = 'an expression that could not be folded'
OF_CALLBACK = 'argument of a callback'


class Value:
    """Anything an expression may stand for; compared by identity unless said otherwise."""

    __slots__ = ()


class Absent(Value):
    """Stands for "no value on this branch" inside a ``Choice``."""

    __slots__ = ()


ABSENT = Absent()


class Const(Value):
    """A constant of a built-in scalar type; equal when type and value are equal."""

    __slots__ = ('value',)

    def __init__(self, value: Any) -> None:
        self.value = value

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Const)
            and type(self.value) is type(other.value)
            and bool(self.value == other.value)
        )

    def __hash__(self) -> int:
        return hash((type(self.value), self.value))

    def __repr__(self) -> str:
        return f'Const({self.value!r})'


NONE = Const(None)


class Mystery(Value):
    """
    A value that could not be followed.

    :param text: how the source calls it; two mysteries of one text and place are one thing.
    :param default: what it is if nothing else is passed (a parameter's default).
    :ivar is_plain: it is a number or a text for certain, whichever.
    """

    __slots__ = ('_text', 'default', 'is_plain', 'unknown')

    def __init__(
        self, unknown: Unknown, text: str | ast.expr = '', default: Value | None = None
    ) -> None:
        self.unknown = unknown
        self._text = text
        self.default = default
        self.is_plain = False

    @property
    def node(self) -> ast.expr | None:
        """The expression, where it was kept as such."""
        return None if isinstance(self._text, str) else self._text

    @property
    def text(self) -> str:
        """Short source of the expression, made on demand."""
        if not isinstance(self._text, str):
            self._text = source_text(self._text)
        return self._text

    @property
    def lacks_caller(self) -> bool:
        """Whether it is what an unknown caller passes."""
        return self.unknown.reason.endswith(NO_CALLER)

    def __repr__(self) -> str:
        return f'Mystery({self.unknown})'


def source_text(node: ast.expr) -> str:
    """Short source of an expression, for messages and to distinguish mysteries."""
    try:
        text = ast.unparse(node)
    except RecursionError:
        return '…'
    return text if len(text) <= _TEXT_LIMIT else f'{text[: _TEXT_LIMIT - 3]}…'


class Choice(Value):
    """
    One of several values, depending on a branch; never nested, never of one option.

    :ivar present: the options but "no value".
    """

    __slots__ = ('options', 'present')

    def __init__(self, options: tuple[Value, ...]) -> None:
        self.options = options
        is_partial = any(option is ABSENT for option in options)
        self.present = tuple(o for o in options if o is not ABSENT) if is_partial else options

    def __repr__(self) -> str:
        return f'Choice{self.options!r}'


SERIALS = count()


class Heaped(Value):
    """
    A value with state; ``slots`` is written by ``store.py`` alone.

    :param serial: grows with every value that is made.
    """

    __slots__ = ('serial', 'slots')

    def __init__(self) -> None:
        self.slots: dict[Any, Any] = {}
        self.serial = next(SERIALS)


class Module(Heaped):
    """A module of the scanned program; slots are its globals."""

    __slots__ = ('file', 'name', 'package', 'stars')

    def __init__(self, name: str, file: str, package: str) -> None:
        super().__init__()
        self.name = name
        self.file = file
        self.package = package
        self.stars: list[Value] = []


class Scope(Heaped):
    """Names of one call, class body or comprehension; ``parent`` is the enclosing function's."""

    __slots__ = ('global_names', 'module', 'nonlocal_names', 'parent')

    def __init__(self, module: Module, parent: Scope | None) -> None:
        super().__init__()
        self.module = module
        self.parent = parent
        self.global_names: set[str] = set()
        self.nonlocal_names: set[str] = set()


FunctionNode = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda


class Function(Heaped):
    """
    A function or lambda of the scanned program, with what it closes over.

    :param qualname: as ``__qualname__``.
    :param owner: class whose body defines it.
    :param defaults: of the last positional parameters, evaluated once at the definition.
    """

    __slots__ = (
        'binding',
        'defaults',
        'keyword_defaults',
        'module',
        'node',
        'owner',
        'qualname',
        'scope',
    )

    def __init__(
        self, node: FunctionNode, module: Module, qualname: str, scope: Scope | None
    ) -> None:
        super().__init__()
        self.node = node
        self.module = module
        self.qualname = qualname
        self.scope = scope
        self.owner: Class | None = None
        self.defaults: tuple[Value, ...] = ()
        self.keyword_defaults: dict[str, Value] = {}
        self.binding = 'method'

    @property
    def name(self) -> str:
        """The bare name, ``<lambda>`` for a lambda."""
        return self.qualname.rpartition('.')[2]

    @property
    def full_name(self) -> str:
        """Qualified name with its module."""
        return f'{self.module.name}.{self.qualname}'

    @property
    def place(self) -> Place:
        """Where the definition stands."""
        return Place(self.module.file, self.node.lineno, self.node.col_offset + 1)

    @property
    def is_coroutine(self) -> bool:
        """True for ``async def``."""
        return isinstance(self.node, ast.AsyncFunctionDef)


class Library(Value):
    """
    Something of a library that is not scanned, by its canonical dotted name.

    :param site: the import that brought it in, for messages.
    """

    __slots__ = ('name',)

    def __init__(self, name: str) -> None:
        self.name = name

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Library) and self.name == other.name

    def __hash__(self) -> int:
        return hash(self.name)

    def __repr__(self) -> str:
        return f'Library({self.name})'


class Class(Heaped):
    """
    A class of the scanned program; slots are its class attributes.

    :param mro: this class first; classes, libraries and mysteries.
    :ivar metaclass: the one that is scanned, of its own or of a base.
    """

    __slots__ = ('bases', 'metaclass', 'module', 'mro', 'name', 'node', 'qualname')

    def __init__(self, name: str, qualname: str, module: Module, node: ast.ClassDef) -> None:
        super().__init__()
        self.name = name
        self.qualname = qualname
        self.module = module
        self.node = node
        self.bases: tuple[Value, ...] = ()
        self.metaclass: Class | None = None
        self.mro: tuple[Value, ...] = (self,)

    @property
    def place(self) -> Place:
        """Where the class statement stands."""
        return Place(self.module.file, self.node.lineno, self.node.col_offset + 1)


class Instance(Heaped):
    """
    An object made by calling a class: one allocation site, one identity.

    :param cls: scanned class or library class.
    :param state: what a library class adds to it (a node, a group, an executor, a thread …).
    :param path: the undecided branches under which it is made.
    :param hint: name of the first variable or attribute it is stored in.
    :param born: what notes the callback that made it, if one did; private to it then.
    :param number: which instance of its class it is, from 1.
    """

    __slots__ = ('born', 'cls', 'hint', 'number', 'path', 'place', 'state')

    def __init__(self, cls: Class | Library, place: Place) -> None:
        super().__init__()
        self.cls = cls
        self.place = place
        self.state: Any = None
        self.path: Path = ()
        self.hint: str | None = None
        self.born: object = None
        self.number = 1

    @property
    def mro(self) -> tuple[Value, ...]:
        """Resolution order of its class."""
        return self.cls.mro if isinstance(self.cls, Class) else (self.cls,)

    @property
    def class_name(self) -> str:
        """Bare name of its class."""
        return self.cls.name.rpartition('.')[2]


class Bound(Value):
    """A scanned method with its receiver."""

    __slots__ = ('function', 'receiver')

    def __init__(self, receiver: Value, function: Function) -> None:
        self.receiver = receiver
        self.function = function

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Bound)
            and other.receiver is self.receiver
            and other.function is self.function
        )

    def __hash__(self) -> int:
        return hash((id(self.receiver), id(self.function)))


class Super(Value):
    """``super()`` inside a method of ``owner``."""

    __slots__ = ('owner', 'receiver')

    def __init__(self, owner: Class, receiver: Value) -> None:
        self.owner = owner
        self.receiver = receiver


class Partial(Value):
    """
    ``functools.partial`` of something callable.

    :param more: why more may be bound than is known.
    """

    __slots__ = ('args', 'function', 'keywords', 'more')

    def __init__(
        self,
        function: Value,
        args: tuple[Value, ...],
        keywords: dict[str, Value],
        more: Unknown | None = None,
    ) -> None:
        self.function = function
        self.args = args
        self.keywords = keywords
        self.more = more


class Coroutine(Value):
    """A coroutine that has been made and not yet been run."""

    __slots__ = ('call', 'function')

    def __init__(self, function: Function, call: Call) -> None:
        self.function = function
        self.call = call


Path = tuple[tuple[Place, int], ...]
"""Undecided branches, outermost first: place of the branching statement, index of the branch."""


@dataclass
class Call:
    """
    The arguments of one call.

    :param place: where the call expression stands.
    :param args: positional arguments, starred ones spread out.
    :param more: why there may be more arguments than these (``*args`` of unknown content).
    :param text: source of the function expression.
    :param sources: shared data that arguments were computed from, by their place or name.
    """

    place: Place
    args: list[Value] = field(default_factory=list)
    keywords: dict[str, Value] = field(default_factory=dict)
    more: Unknown | None = None
    text: str | ast.expr = ''
    sources: dict[int | str, frozenset[str]] = field(default_factory=dict)

    def argument(self, index: int | None, *names: str) -> Value | None:
        """The argument at ``index`` or of one of ``names``; a mystery when it may be passed."""
        for name in names:
            if name in self.keywords:
                return self.keywords[name]
        if index is not None and index < len(self.args):
            return self.args[index]
        return Mystery(self.more, names[0] if names else '') if self.more else None

    def bound_to(self, receiver: Value) -> Call:
        """The same call with ``receiver`` as first argument."""
        args = [receiver, *self.args]
        moved = {at + 1 if isinstance(at, int) else at: of for at, of in self.sources.items()}
        return Call(self.place, args, self.keywords, self.more, self.text, moved)


Handler = Callable[[Any, Value, Call], Value]
"""
A library function: the machine, the receiver (or what stands before the dot), the call.

Which machine it needs is for the function to say: one of ``math`` is content with any, one of
``threading`` needs one that notes which code waits.
"""


class Native(Value):
    """A library function or method whose effect is known."""

    __slots__ = ('handler', 'name', 'receiver')

    def __init__(self, name: str, handler: Handler, receiver: Value = NONE) -> None:
        self.name = name
        self.handler = handler
        self.receiver = receiver

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Native)
            and other.handler is self.handler
            and other.receiver is self.receiver
        )

    def __hash__(self) -> int:
        return hash((self.name, id(self.receiver)))


def options_of(value: Value) -> tuple[Value, ...]:
    """All the values ``value`` may stand for; "no value" is left out."""
    if value.__class__ is Choice:
        return value.present
    return () if value is ABSENT else (value,)


def present(value: Choice) -> Value:
    """The same choice without "no value"."""
    return value if value.present is value.options else choice(list(value.present))


_MAX_OPTIONS = 16


def choice(values: list[Value]) -> Value:
    """One value that stands for all of ``values``, in order, each once."""
    flat: list[Value] = []
    for value in values:
        for option in value.options if isinstance(value, Choice) else (value,):
            if option not in flat:
                flat.append(option)
        if len(flat) > _MAX_OPTIONS:
            many = Mystery(Unknown('one of many values, depending on branches'))
            many.is_plain = all(map(is_number_or_text, flat))
            return many
    return flat[0] if len(flat) == 1 else Choice(tuple(flat))


_PLAIN = (int, float, complex, str, bytes)
# What began as a number and was computed since is one still.
_STILL = ('is assigned anew by other methods', NOT_FOLDED)


def is_number_or_text(value: Value) -> bool:
    """Whether ``value`` is a number or a text, so that no code of Python computes with it."""
    options = options_of(value)
    known = [each for each in options if _is_plain(each)]
    others = [each for each in options if not _is_plain(each)]
    return bool(known) and all(isinstance(each, Mystery) and _stays_plain(each) for each in others)


def _stays_plain(value: Mystery) -> bool:
    """What holds a number at times and a field of a message at others holds numbers only."""
    is_given = value.unknown.reason == OF_CALLBACK and '(' not in value.text
    return value.unknown.reason.endswith(_STILL) or (is_given and '.' in value.text)


def _is_plain(value: Value) -> bool:
    if isinstance(value, Mystery):
        return value.is_plain
    return isinstance(value, Const) and isinstance(value.value, _PLAIN)
