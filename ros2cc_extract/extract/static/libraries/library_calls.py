"""How the machine uses the library tables: names, instances, members, unknown bases."""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable
from functools import partial
from typing import Any

from ros2cc_extract.extract.static.concurrency.accesses.held_locks import is_counter
from ros2cc_extract.extract.static.concurrency.activities import run_in_thread
from ros2cc_extract.extract.static.libraries import model
from ros2cc_extract.extract.static.libraries.rclpy.tables.clients import (
    NODE_EXECUTOR,
    UNKNOWN_CLIENT,
    result_of,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.durations import time_from_now
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import (
    CREATE_CALLS,
    NODE,
    ghost_node,
    make_node,
)
from ros2cc_extract.extract.static.libraries.standard.futures import is_pool, note_leaving
from ros2cc_extract.extract.static.python.machine.library_table import LibraryClass
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.wake_operations import Word
from ros2cc_extract.extract.static.python.machine.world import (
    AS_THREAD,
    NodeState,
    PlainState,
    ThreadState,
)
from ros2cc_extract.extract.static.python.objects import reanalysis
from ros2cc_extract.extract.static.python.objects.allocation_sites import made_before, remember
from ros2cc_extract.extract.static.python.objects.escape import reached
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Library,
    Mystery,
    Native,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.places import Place, Unknown

_ENTITY_ONLY = frozenset((*CREATE_CALLS, 'create_rate'))
_NODE_ONLY = _ENTITY_ONLY | {'create_publisher'}

_SPINS = frozenset(
    {'spin', 'spin_until_future_complete', 'rclpy.spin', 'rclpy.spin_until_future_complete'}
)

# Helpers of the ROS libraries that take a node and add nothing its executor would serve.
_HARMLESS = (
    'tf2_ros.',
    'rclpy.',
    'builtins.',
    'rosidl',
    'cv_bridge',
    'diagnostic_updater.',
    'launch',
)
_CLOCKS = ('time', 'monotonic', 'perf_counter', 'process_time', 'thread_time')
_NUMBERS = frozenset(f'time.{clock}{unit}' for clock in _CLOCKS for unit in ('', '_ns'))
"""What they give is a number."""


_OF_THREADS = ('threading.Thread', 'threading.Timer', 'multiprocessing.Process')
_HANDED_ON = 'it is handed to code that is not followed'
# Things looked at in what is given away; a graph of objects may be large.


def _add_state(instance: Instance, make: Callable[[], Any], name: str) -> None:
    """What is a thread besides, as a node may be, keeps that apart: each has its own methods."""
    is_thread = isinstance(instance.state, ThreadState)
    if instance.state is None:
        instance.state = make()
    elif is_thread is not name.startswith(_OF_THREADS) and AS_THREAD not in instance.slots:
        made = make()
        instance.slots[AS_THREAD] = instance.state if is_thread else made
        instance.state = made if is_thread else instance.state


class Libraries(Machine):
    """What is known of code that is not scanned."""

    def library(self, name: str) -> Value:
        """What a dotted name of a library stands for."""
        known = model.canonical(name)
        constant = model.table().constants.get(known)
        if constant is not None:
            return constant
        handler = model.table().functions.get(known)
        return Native(known, handler) if handler else Library(known)

    def prepare(self, instance: Instance) -> None:
        """Give a new instance the state that its library bases add."""
        for cls in instance.mro:
            if isinstance(cls, Library):
                rows = _with_bases(cls.name)
                make = next((row.state for row in rows if row.state is not None), None)
                if make is not None:
                    _add_state(instance, partial(make, self, instance), cls.name)

    def call_library(self, function: Library, call: Call) -> Value:
        """Call a name of a library: make an instance, or give a mystery."""
        rows = _with_bases(function.name)
        if not rows:
            return self.unknown_result(function, call)
        known = reanalysis.made_then(self.world, function, call.place)
        known = known or made_before(self, function, call)
        instance = known or Instance(function, call.place)
        reanalysis.remember(self.world, function, call.place, instance)
        if known is not None:
            self._begin_anew(known, rows)
            return known
        instance.path = self.world.path
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
        result.is_plain = name in _NUMBERS
        return result

    def library_call(self, function: Value, call: Call) -> None:
        """Something unknown is called, perhaps with a node among its arguments."""
        if isinstance(function, Library) and function.name.startswith(_HARMLESS):
            return
        name = function.name if isinstance(function, Library) else ''
        if isinstance(function, Mystery):
            name = function.text
        self._keep_escaped(call)
        if not name or self._is_standard(name):
            return
        for argument in (*call.args, *call.keywords.values()):
            for option in options_of(argument):
                if isinstance(option, Instance) and isinstance(option.state, NodeState):
                    reason = f'the node is passed to {name}, which is not scanned'
                    option.state.more.append((reason, call.place))

    def _keep_escaped(self, call: Call) -> None:
        """Functions that are handed to unknown code may be called by it, later."""
        for index, argument in enumerate((*call.args, *call.keywords.values())):
            for option in options_of(argument):
                if isinstance(option, (Function, Bound, Partial)):
                    self.world.escaped.append((option, call.place))
                elif isinstance(option, Native) and option.name in _SPINS:
                    # Whoever is given a spin runs it, with what is handed along.
                    run_in_thread(self, option, Call(call.place, call.args[index + 1 :]))
                else:
                    self.give_away(option, _HANDED_ON, call.place)

    def give_away(self, value: Value, reason: str, place: Place) -> None:
        """
        Note that code that is not followed has an event, a queue …, or a method of one.

        It may end waits then, and so it may with what is inside of a list, a tuple or an object.
        """
        for thing in reached(value):
            known = self.world.given.get(id(thing))
            # What a queue does with it may be seen in the end; nobody sees what others do.
            if known is None or (known.reason != reason and 'queue' in known.reason):
                self.world.given[id(thing)] = Unknown(reason, place)

    def _is_standard(self, name: str) -> bool:
        return name.partition('.')[0] in sys.stdlib_module_names

    def library_member(
        self, cls: Library, receiver: Value | None, name: str, place: Place
    ) -> Value | None:
        """Attribute ``name`` that a library class gives to ``receiver``."""
        rows = _with_bases(cls.name)
        for row in rows:
            if receiver is None or not isinstance(receiver, Instance):
                return self._unbound(cls, row, name)
            if name in row.properties:
                return row.properties[name](self, receiver, place)
            if name == '__init__' and row.init is not None:
                return Native('__init__', row.init, receiver)
            if name in row.methods:
                return Native(name, row.methods[name], receiver)
        if (
            rows
            and cls.name.startswith('rclpy.')
            and name == 'executor'
            and isinstance(receiver, Instance)
            and isinstance(receiver.state, NodeState)
        ):
            return NODE_EXECUTOR[1](self, receiver, place)
        return None

    def _unbound(self, cls: Library, row: LibraryClass, name: str) -> Value | None:
        """``Node.__init__(self, …)``: the receiver is the first argument."""
        handler = row.init if name == '__init__' else row.methods.get(name)
        if handler is None:
            return None

        def call_unbound(machine: Machine, receiver: Value, call: Call) -> Value:
            if not call.args or not _is_of(call.args[0], cls):
                return machine.mystery(f'{name} of something that is no {cls.name}', call.place)
            inner = Call(call.place, call.args[1:], call.keywords, call.more, call.text)
            return handler(machine, call.args[0], inner)

        return Native(name, call_unbound)

    def member_of_unknown_base(
        self, order: tuple[Value, ...], receiver: Value, name: str, place: Place
    ) -> Value | None:
        """A node's method on a class whose base is not in sight makes it a node."""
        if not isinstance(receiver, Instance):
            return None
        if name in _NODE_ONLY:
            self.become_node(receiver)
        if not isinstance(receiver.state, NodeState) or self._unknown_base(receiver) is None:
            return None
        return self.library_member(Library(NODE), receiver, name, place)

    def become_node(self, instance: Instance) -> Instance | None:
        """Treat an instance of a class with an unknown base as the node it is used as."""
        if isinstance(instance.state, NodeState):
            return instance
        base = self._unknown_base(instance)
        if base is None or instance.state is not None:
            return None
        instance.state = make_node(self, instance)
        name = base.name if isinstance(base, Library) else 'which could not be followed'
        at = instance.cls.place if isinstance(instance.cls, Class) else instance.place
        instance.state.more.append((f'its base class {name} is not scanned and may add more', at))
        return instance

    def _unknown_base(self, instance: Instance) -> Value | None:
        for cls in instance.mro:
            if isinstance(cls, Class):
                continue
            if not isinstance(cls, Library):
                return cls
            if not self._is_standard(cls.name) and not cls.name.startswith('builtins.'):
                return cls if not _with_bases(cls.name) else None
        return None

    def member_of_mystery(self, value: Mystery, name: str, place: Place) -> Value | None:
        """Attribute ``name`` of a value that must be a node, or a client."""
        if name in UNKNOWN_CLIENT and not _is_no_node(value):
            return Native(name, UNKNOWN_CLIENT[name], value)
        if name in _ENTITY_ONLY and value.text and not _is_no_node(value):
            return self.library_member(Library(NODE), ghost_node(self, value), name, place)
        return None

    def leave_context(self, value: Value, place: Place) -> None:
        """A ``with`` over ``value`` ends; a pool waits for all that was handed to it."""
        if is_pool(value):
            note_leaving(self, value, place)
        state = value.state if isinstance(value, Instance) else None
        is_stock = isinstance(state, PlainState) and state.kind == 'semaphore'
        if is_stock or (isinstance(value, Instance) and is_counter(self.world, value)):
            self.note_wake(value, Word.RELEASE, place)
            self.note_release(value)

    def library_operation(self, op: ast.operator, left: Value, right: Value) -> Value | None:
        """What an operator gives that a library defines."""
        return time_from_now(op, left, right)

    def awaited(self, future: Instance, place: Place) -> Value:
        """What awaiting a future gives."""
        return result_of(self, future, place)

    def future(self, place: Place, kind: str, of: Value | None = None) -> Instance:
        """A new future of ``kind``."""
        made = Instance(Library('rclpy.task.Future'), place)
        made.state = PlainState(kind, of=of, place=place)
        return made


def _is_of(value: Value, cls: Library) -> bool:
    return isinstance(value, Instance) and any(
        isinstance(base, Library) and model.canonical(cls.name) in model.with_bases(base.name)
        for base in value.mro
    )


def _is_no_node(value: Mystery) -> bool:
    """Mocks of tests and clients of other frameworks have methods of the same names."""
    text = f'{value.text} {value.unknown.reason}'.lower()
    return any(word in text for word in ('mock', 'simplenamespace', 'boto', 'session', 'requests'))


def _with_bases(name: str) -> list[LibraryClass]:
    """The rows of a library class and of its bases, nearest first."""
    classes = model.table().classes
    return [classes[base] for base in model.with_bases(name)]
