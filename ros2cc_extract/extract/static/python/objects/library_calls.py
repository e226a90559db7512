"""How the interpreter uses the library tables: names, instances, members, calls of the unknown."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from ros2cc_extract.extract.static.python.machine.library_state import BESIDE, LibraryState
from ros2cc_extract.extract.static.python.machine.library_table import LibraryClass
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects import reanalysis
from ros2cc_extract.extract.static.python.objects.allocation_sites import made_before, remember
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Function,
    Instance,
    Library,
    Mystery,
    Native,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown

_HANDED_ON = 'it is handed to code that is not followed'


class LibraryCalls(Machine):
    """What is known of code that is not scanned."""

    def library(self, name: str) -> Value:
        """What a dotted name of a library stands for."""
        known = self.model.canonical(name)
        constant = self.model.table.constants.get(known)
        if constant is not None:
            return constant
        handler = self.model.table.functions.get(known)
        return Native(known, handler) if handler else Library(known)

    def prepare(self, instance: Instance) -> None:
        """Give a new instance the state that its library bases add."""
        for cls in instance.mro:
            if isinstance(cls, Library):
                rows = self.model.rows(cls.name)
                row = next((row for row in rows if row.state is not None), None)
                if row is not None and row.state is not None:
                    _add_state(instance, partial(row.state, self, instance), row)

    def call_library(self, function: Library, call: Call) -> Value:
        """Call a name of a library: make an instance, or give a mystery."""
        rows = self.model.rows(function.name)
        if not all(row.matters is None or row.matters(call) for row in rows):
            rows = []
        if not rows:
            return self.unknown_result(function, call)
        known = reanalysis.made_then(self.world, function, call.place)
        known = known or made_before(self, function, call)
        instance = known or Instance(function, call.place)
        reanalysis.remember(self.world, function, call.place, instance)
        if known is not None:
            self._begin_anew(known, rows)
            return known
        instance.path, instance.born = self.world.path, self.world.effects
        self.prepare(instance)
        remember(self, instance, call)
        init = next((row.init for row in rows if row.init is not None), None)
        if init is not None:
            init(self, instance, call)
        self.world.instances.append(instance)
        return instance

    def _begin_anew(self, known: Instance, rows: list[LibraryClass]) -> None:
        for row in rows:
            if row.again is not None:
                row.again(self, known)

    def unknown_result(self, function: Value, call: Call) -> Value:
        """The result of a library call that nothing is known of."""
        self.library_call(function, call)
        name = function.name if isinstance(function, Library) else 'an unknown function'
        why = Unknown(f'result of {name}, which is not scanned', call.place)
        result = Mystery(why, f'{name}(…)')
        result.is_plain = name in self.model.table.plain
        if not result.is_plain and not self.model.makes_data(name):
            self.world.outside_objects.add(why)
        return result

    def library_call(self, function: Value, call: Call) -> None:
        """Something unknown is called, perhaps with objects of a library among its arguments."""
        if isinstance(function, Library) and function.name.startswith(self.model.harmless):
            return
        name = function.name if isinstance(function, Library) else ''
        if isinstance(function, Mystery):
            name = function.text
        self._keep_escaped(call)
        if is_standard(name) and not name.startswith(CALLING_BACK):
            return
        self.note_library_call(name, call.place)
        self.note_handed((*call.args, *call.keywords.values()), call.place, name, function)
        given = (each for a in (*call.args, *call.keywords.values()) for each in options_of(a))
        self.world.seen_outside |= {id(each) for each in given if isinstance(each, Instance)}
        if not name:
            return
        why = Unknown(f'it is handed to {name}, which is not scanned', call.place)
        for argument in (*call.args, *call.keywords.values()):
            for option in options_of(argument):
                if isinstance(option, Instance) and isinstance(option.state, LibraryState):
                    if not self.world.only_data:
                        option.state.note_passed(name, call.place)
                elif isinstance(option, Collection) and not self.model.makes_data(name):
                    self.world.handed_over.setdefault(option, why)

    def note_handed(
        self, values: Iterable[Value], place: Place, name: str, by: Value | None = None
    ) -> None:
        """Functions that code which is not scanned has now, and may call on any thread."""
        whose = by.unknown.reason if isinstance(by, Mystery) else ''
        for value in values:
            for option in options_of(value):
                if isinstance(option, (Function, Bound, Partial)):
                    self.world.handed.append((option, place, name or 'code', whose))

    def _keep_escaped(self, call: Call) -> None:
        """Functions that are handed to unknown code may be called by it, later."""
        for index, argument in enumerate((*call.args, *call.keywords.values())):
            for option in options_of(argument):
                if isinstance(option, (Function, Bound, Partial)):
                    self.world.escaped.append((option, call.place))
                elif not isinstance(option, Native) or not self.takes_over(
                    option, call.args[index + 1 :], call.place
                ):
                    self.give_away(option, _HANDED_ON, call.place)

    def library_member(
        self, cls: Library, receiver: Value | None, name: str, place: Place
    ) -> Value | None:
        """Attribute ``name`` that a library class gives to ``receiver``."""
        rows = self.model.rows(cls.name)
        for row in rows:
            if receiver is None or not isinstance(receiver, Instance):
                return self._unbound(cls, row, name)
            if name in row.properties:
                return row.properties[name](self, receiver, place)
            if name == '__init__' and row.init is not None:
                return Native('__init__', row.init, receiver)
            if name in row.methods:
                return Native(name, row.methods[name], receiver)
        return self.other_member(cls, receiver, name, place) if rows else None

    def _unbound(self, cls: Library, row: LibraryClass, name: str) -> Value | None:
        """``Node.__init__(self, …)``: the receiver is the first argument."""
        handler = row.init if name == '__init__' else row.methods.get(name)
        if handler is None:
            return None

        def call_unbound(machine: LibraryCalls, receiver: Value, call: Call) -> Value:
            if not call.args or not machine.is_of(call.args[0], cls):
                return machine.mystery(f'{name} of something that is no {cls.name}', call.place)
            inner = Call(call.place, call.args[1:], call.keywords, call.more, call.text)
            return handler(machine, call.args[0], inner)

        return Native(name, call_unbound)

    def is_of(self, value: Value, cls: Library) -> bool:
        """Whether ``value`` is an object of a library class, or of one derived from it."""
        return isinstance(value, Instance) and any(
            isinstance(base, Library) and self.model.is_a(base.name, cls.name)
            for base in value.mro
        )


def _add_state(instance: Instance, make: Callable[[], Any], row: LibraryClass) -> None:
    """What is also something else, as a node may be a thread, keeps that apart."""
    first = instance.state
    if first is None:
        instance.state = make()
        return
    is_beside = isinstance(first, LibraryState) and first.is_beside
    if is_beside is not row.is_beside and BESIDE not in instance.slots:
        made = make()
        instance.slots[BESIDE] = first if is_beside else made
        instance.state = made if is_beside else first


CALLING_BACK = ('tkinter.', 'sched.', 'weakref.', 'sys.', 'gc.', 'threading.', 'multiprocessing.')
"""Of the standard library, what calls functions later, in a thread of its own choice."""


def is_standard(name: str) -> bool:
    """Whether a dotted name is one of the standard library."""
    return name.partition('.')[0] in sys.stdlib_module_names
