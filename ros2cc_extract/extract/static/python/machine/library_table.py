"""The form of the library tables: which classes and functions have which effects."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import Handler, Instance, Value
from ros2cc_extract.places import Place

AWAITED = '__awaited__'
"""Slot of a coroutine of a library: what happens when it is awaited."""

StateFactory = Callable[[Machine, Instance], Any]
Property = Callable[[Machine, Instance, Place], Value]


@dataclass(frozen=True)
class LibraryClass:
    """
    A library class whose instances matter.

    :param state: makes what an instance has beyond its attributes.
    :param init: what ``__init__`` does; the receiver is the instance.
    :param again: what holds for an instance that is made again, by who made it before.
    """

    state: StateFactory | None = None
    init: Handler | None = None
    again: Callable[[Machine, Instance], None] | None = None
    bases: tuple[str, ...] = ()
    methods: dict[str, Handler] = field(default_factory=dict)
    properties: dict[str, Property] = field(default_factory=dict)


@dataclass(frozen=True)
class Library:
    """A table of classes, functions and other names of them."""

    classes: dict[str, LibraryClass] = field(default_factory=dict)
    functions: dict[str, Handler] = field(default_factory=dict)
    aliases: dict[str, str] = field(default_factory=dict)
    constants: dict[str, Value] = field(default_factory=dict)
    added_methods: dict[str, dict[str, Handler]] = field(default_factory=dict)


def with_methods(row: LibraryClass, methods: dict[str, Handler]) -> LibraryClass:
    """The same class with some methods more, or other ones."""
    return replace(row, methods={**row.methods, **methods})


def merged(tables: list[Library]) -> Library:
    """One table of all."""
    whole = Library()
    for table in tables:
        whole.classes.update(table.classes)
        whole.functions.update(table.functions)
        whole.aliases.update(table.aliases)
        whole.constants.update(table.constants)
    for table in tables:
        for name, methods in table.added_methods.items():
            whole.classes[name] = with_methods(whole.classes[name], methods)
    return whole
