"""
The form of the library tables: which classes and functions have which effects.

To follow programs of another library, write its table and hand a ``LibraryModel`` of it, beside
those of Python itself, to the interpreter.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from ros2cc_extract.extract.static.python.values.values import Call, Handler, Instance, Value
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

AWAITED = '__awaited__'
"""Slot of a coroutine of a library: what happens when it is awaited."""

_KEPT = 4096

StateFactory = Callable[[Any, Instance], Any]
Property = Callable[[Any, Instance, Place], Value]


@dataclass(frozen=True)
class LibraryClass:
    """
    A library class whose instances matter.

    :param state: makes what an instance has beyond its attributes.
    :param init: what ``__init__`` does; the receiver is the instance.
    :param is_beside: an object may be this in addition to what another base class makes of it.
    :param again: what holds for an instance that is made again, by what made it before.
    :param matters: whether an instance does that is made with these arguments.
    :param has: whether an instance may have an attribute of that name; not known for most classes.
    """

    state: StateFactory | None = None
    init: Handler | None = None
    again: Callable[[Any, Instance], None] | None = None
    bases: tuple[str, ...] = ()
    is_beside: bool = False
    matters: Callable[[Call], bool] | None = None
    methods: dict[str, Handler] = field(default_factory=dict)
    properties: dict[str, Property] = field(default_factory=dict)
    has: Callable[[str], bool] | None = None


@dataclass(frozen=True)
class Library:
    """
    A table of classes, functions and other names of them.

    :param plain: functions without a row that give a number or a text, whichever.
    """

    classes: dict[str, LibraryClass] = field(default_factory=dict)
    functions: dict[str, Handler] = field(default_factory=dict)
    aliases: dict[str, str] = field(default_factory=dict)
    constants: dict[str, Value] = field(default_factory=dict)
    plain: frozenset[str] = frozenset()
    added_methods: dict[str, dict[str, Handler]] = field(default_factory=dict)


def with_methods(row: LibraryClass, methods: dict[str, Handler]) -> LibraryClass:
    """The same class with some methods more, or other ones."""
    return replace(row, methods={**row.methods, **methods})


def merged(tables: list[Library]) -> Library:
    """One table of all."""
    whole = Library(plain=frozenset().union(*(table.plain for table in tables)))
    for table in tables:
        whole.classes.update(table.classes)
        whole.functions.update(table.functions)
        whole.aliases.update(table.aliases)
        whole.constants.update(table.constants)
    for table in tables:
        for name, methods in table.added_methods.items():
            whole.classes[name] = with_methods(whole.classes[name], methods)
    return whole


class LibraryModel:
    """
    What is known of code that is not scanned: a class or function of any name.

    :param harmless: how names begin of what does nothing with what it is given.
    :param making: how methods are called that make what matters: where one is asked for and
        cannot be followed, something is missing.
    :param acting: names in whose text more is done than to compute something.
    :param waits: what ends each wait, by its name, see ``wait_table.py``.
    :param data: prefixes of names whose results change only when the program changes them.
    """

    def __init__(
        self,
        tables: Sequence[Library],
        *,
        harmless: tuple[str, ...] = (),
        making: tuple[str, ...] = (),
        acting: frozenset[str] = frozenset(),
        waits: Mapping[str, Any] = MappingProxyType({}),
        data: tuple[str, ...] = (),
    ) -> None:
        self.table = merged(list(tables))
        self.harmless, self.making, self.acting = harmless, making, acting
        self.waits, self._data = waits, data
        self.canonical: Callable[[str], str] = lru_cache(_KEPT)(self._canonical)
        """The one name under which a name stands in the tables."""
        self.with_bases: Callable[[str], tuple[str, ...]] = lru_cache(_KEPT)(self._with_bases)
        """A library class and its bases, as they stand in the tables, nearest first."""

    def _canonical(self, name: str) -> str:
        name = self.table.aliases.get(name, name)
        if name in self.table.classes or name in self.table.functions:
            return name
        return self.other_name(name)

    def other_name(self, name: str) -> str:
        """The name in the tables of what stands in none under ``name``."""
        return name

    def makes_data(self, name: str) -> bool:
        """Whether what a function or class gives changes only as the program changes it."""
        return name.startswith(self._data)

    def _with_bases(self, name: str) -> tuple[str, ...]:
        classes, found, waiting = self.table.classes, list[str](), [self.canonical(name)]
        while waiting:
            known = waiting.pop(0)
            if known in classes:
                found.append(known)
                waiting.extend(classes[known].bases)
        return tuple(found)

    def rows(self, name: str) -> list[LibraryClass]:
        """The rows of a library class and of its bases, nearest first."""
        return [self.table.classes[base] for base in self.with_bases(name)]

    def is_a(self, name: str, base: str) -> bool:
        """Whether a library class is another one, or has it as a base."""
        return self.canonical(base) in self.with_bases(name)
