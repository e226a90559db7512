"""Runs of the abstract machine: from an entry, over the callbacks, to what is never called."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

from ros2cc_extract.extract.static.concurrency.accesses.signal_locks import signals_of
from ros2cc_extract.extract.static.concurrency.accesses.unreleased_locks import note_kept_locks
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import may_be_called
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.called_by_services import (
    TRANSITIONS,
)
from ros2cc_extract.extract.static.libraries.standard.exit_hooks import run_exit_hooks
from ros2cc_extract.extract.static.libraries.standard.queue_items import take_back
from ros2cc_extract.extract.static.program.call_order import (
    callers_first,
    leading_to_entities,
)
from ros2cc_extract.extract.static.program.entry_points import Entry
from ros2cc_extract.extract.static.program.given_parameters import NONE_GIVEN
from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.program.relevance import creates_entities
from ros2cc_extract.extract.static.program.text_queries import is_test, walk
from ros2cc_extract.extract.static.python.values.unknown_callers import unknown_arguments
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Library,
    Partial,
    Value,
)
from ros2cc_extract.extract.static.scan.callback_runs import (
    MOST_CALLBACKS,
    is_closing,
    run_callbacks,
)
from ros2cc_extract.extract.static.scan.first_runs import follow_first_runs, stored_by_set_up
from ros2cc_extract.extract.static.scan.guarded_runs import guarded
from ros2cc_extract.extract.static.scan.handed_functions import follow_handed
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter
from ros2cc_extract.extract.static.scan.test_programs import PREPARING, begin_test, end_test
from ros2cc_extract.extract.static.scan.texts_that_act import leads_to_waits, may_make_entities
from ros2cc_extract.extract.static.units.event_loops.foreign_loop_calls import (
    note_foreign_loops,
    note_missing_loops,
)
from ros2cc_extract.extract.static.units.event_loops.locks_over_awaits import (
    note_locks_over_awaits,
)
from ros2cc_extract.extract.static.units.whole_program.double_spins import note_spun_twice
from ros2cc_extract.extract.static.units.whole_program.endless_readers import (
    note_endless_readers,
)
from ros2cc_extract.extract.static.units.whole_program.ends_while_served import note_ends
from ros2cc_extract.extract.static.units.whole_program.nodes_taken_by_threads import (
    note_taken_by_threads,
)
from ros2cc_extract.extract.static.units.whole_program.taken_messages import note_taken
from ros2cc_extract.extract.static.units.whole_program.unanswered_waits import note_unanswered
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import When

_DESTROYING = 'on_deactivate'
_CALLS_NOTHING = frozenset(
    [
        'builtins.object',
        'abc.ABC',
        'typing.Generic',
        'rclpy.node.Node',
        'rclpy.lifecycle.Node',
        'rclpy.lifecycle.LifecycleNode',
    ]
)
"""Bases that call no method by a name of the program's own."""
UNCALLED = -3
"""Step of a path that an unknown caller takes."""


def run_entry(project: Project, entry: Entry) -> RosInterpreter:
    """Follow a program from one of its entries, then its callbacks."""
    machine = _run_entry(project, entry, frozenset())
    signals = signals_of(machine.world)
    return _run_entry(project, entry, signals) if signals else machine


def _run_entry(project: Project, entry: Entry, signals: frozenset[Place]) -> RosInterpreter:
    """The same, where it is known already where the locks are made that are signals."""
    machine = RosInterpreter(project)
    machine.world.signals = signals
    machine.world.is_program = True
    place = Place(entry.source.shown, 1, 1)

    def follow() -> None:
        module = machine.run_module(entry.source, '__main__' if not entry.function else '')
        if entry.function:
            function = module.slots.get(entry.function)
            if isinstance(function, Value):
                result = machine.call(function, Call(place))
                machine.run_if_coroutine(result, place)
        run_exit_hooks(machine)

    guarded(machine, follow, place, entry.source.tree)
    stored = stored_by_set_up(machine.world)
    _run_escaped(machine)
    run_callbacks(machine)
    run_rest_of_instances(machine)
    follow_first_runs(machine, stored)
    take_back(machine.world)
    note_kept_locks(machine.world)
    note_unanswered(machine.world)
    note_spun_twice(machine.world)
    note_taken_by_threads(machine.world)
    note_taken(machine.world)
    note_ends(machine.world)
    note_foreign_loops(machine.world)
    note_missing_loops(machine.world)
    note_endless_readers(machine.world)
    follow_handed(machine)
    note_locks_over_awaits(machine.world)
    return machine


def _run_escaped(machine: RosInterpreter) -> None:
    """Functions handed to code that is not scanned, such as the loop of another framework."""
    world = machine.world
    for value, place in world.escaped[:MOST_CALLBACKS]:
        inner = value
        while isinstance(inner, Partial):
            inner = inner.function
        function = inner.function if isinstance(inner, Bound) else inner
        if not isinstance(function, Function) or id(function.node) in world.called:
            continue
        if may_make_entities(world, function.node) or leads_to_waits(world, function.node):
            world.escaped_to_unknown.add(id(function.node))
            _run_escaped_one(machine, value, function, place)


def _run_escaped_one(
    machine: RosInterpreter, value: Value, function: Function, place: Place
) -> None:
    def follow() -> None:
        machine.world.path = ((place, UNCALLED),)
        machine.world.when = When.LATER
        machine.world.after_spin = False
        skip = 1 if isinstance(value, Bound) else 0
        call = (
            Call(place) if isinstance(value, Partial) else unknown_arguments(function, place, skip)
        )
        machine.run_if_coroutine(machine.call(value, call), place)

    with _called_later(machine.world):
        guarded(machine, follow, place)


@contextmanager
def _called_later(world: RosWorld) -> Iterator[None]:
    """What is called first inside has no known caller but what unknown code calls."""
    before = frozenset(world.called)
    yield
    world.called_later |= world.called.keys() - before


def run_rest_of_instances(machine: RosInterpreter) -> None:
    """Methods without a known caller that make entities; they may be called later."""
    seen = 0
    while seen < min(len(machine.world.instances), MOST_CALLBACKS):
        instance = machine.world.instances[seen]
        seen += 1
        if machine.world.settled.get(id(instance)) == _stamp(machine.world, instance):
            continue
        for method in _methods_without_caller(machine, instance):
            if _lacks_caller(machine.world, method, instance):
                number = id(method.text.node)
                machine.world.without_caller.setdefault(number, set()).add(id(instance))
                _run_later(machine, instance, method.name, method.function)
                machine.world.followed_later.update(instance.mro)
                run_callbacks(machine)
        machine.world.settled[id(instance)] = _stamp(machine.world, instance)


def _stamp(world: RosWorld, instance: Instance) -> int:
    """Grows whenever there may be something new to follow in ``instance``."""
    return sum(
        world.followed_later[cls] + len(cls.slots)
        for cls in instance.mro
        if isinstance(cls, Class)
    )


@dataclass(frozen=True)
class _Method:
    """
    A method as it is called.

    :param function: what a decorator has made of it.
    :param text: the function that stands under that name in the class.
    :param is_hidden: it is only called if its decorator does so.
    """

    name: str
    function: Function
    text: Function
    is_hidden: bool = False


def _lacks_caller(world: RosWorld, method: _Method, instance: Instance) -> bool:
    """
    Whether it has no known caller.

    It is followed for each object that the set-up makes, and once for others of its class; one
    that only the class itself calls is followed once as well, even if the class does not reach it.
    """
    number = id(method.text.node)
    is_of_set_up = all(step != UNCALLED for _, step in instance.path)
    followed = world.without_caller.get(number, set())
    is_other = bool(followed) and id(instance) not in followed and is_of_set_up
    is_private = method.is_hidden or method.name.startswith('_')
    return number not in world.called or (is_other and not is_private)


def _is_left_out(world: RosWorld, method: _Method, instance: Instance) -> bool:
    """
    Whether its class hands it on where the parameters of the launch do not lead.

    Without a launch all branches are followed, and what is handed on has a caller.
    """
    if world.parameters == NONE_GIVEN:
        return False
    texts = (cls.node for cls in instance.mro if isinstance(cls, Class))
    return any(
        isinstance(part, ast.Attribute) and part.attr == method.name
        for text in texts
        for part in walk(text)
    )


def _methods_without_caller(machine: RosInterpreter, instance: Instance) -> list[_Method]:
    """
    Methods not followed yet that lead to entities, callers before what they call.

    Using a scanned class or function that makes some leads to entities too.
    """
    left = [
        method
        for method in _methods_of(machine, instance)
        if _lacks_caller(machine.world, method, instance)
        and not _is_left_out(machine.world, method, instance)
    ]
    modules = {id(method.text.module): method.text.module for method in left}
    makers = frozenset(
        name
        for module in modules.values()
        for name, value in module.slots.items()
        if isinstance(value, (Class, Function))
        and value not in instance.mro
        and creates_entities(value.node)
    )
    names, nodes = [method.name for method in left], [method.function.node for method in left]
    or_wait = partial(_may_be_called, machine.world, instance)
    wanted = leading_to_entities(names, nodes, makers, or_wait=or_wait)
    if isinstance(instance.state, NodeState) and instance.state.lifecycle:
        wanted |= {_DESTROYING}
    return [method for method in callers_first(left, names, nodes) if method.name in wanted]


def _may_be_called(world: RosWorld, instance: Instance, method: str) -> bool:
    """Whether other code, Python itself or a base class that is not scanned may call a method."""
    is_plain = all(
        isinstance(cls, Class) or (isinstance(cls, Library) and cls.name in _CALLS_NOTHING)
        for cls in instance.mro
    )
    behind = any(function.name == method for function in world.decorated)
    return behind or not is_plain or may_be_called(world, method)


def _methods_of(machine: RosInterpreter, instance: Instance) -> list[_Method]:
    """Its methods with their decorators, and then those that a decorator has not called."""
    behind = {
        (function.owner, function.name): function
        for function in machine.world.decorated
        if function.owner is not None and function.owner in instance.mro
    }
    found: dict[str, _Method] = {}
    for cls in instance.mro:
        if isinstance(cls, Class):
            for name, value in cls.slots.items():
                if isinstance(value, Function) and name not in found:
                    found[name] = _Method(name, value, behind.get((cls, name), value))
    hidden = (_Method(text.name, text, text, is_hidden=True) for text in behind.values())
    methods = [*found.values(), *hidden]
    lifecycle = isinstance(instance.state, NodeState) and instance.state.lifecycle
    return sorted(methods, key=lambda each: (_turn(each.name, lifecycle), each.text.node.lineno))


def _turn(name: str, lifecycle: bool) -> int:
    """What others build on comes first, what each test calls for itself last."""
    is_first = name in (TRANSITIONS if lifecycle else ('setUpClass', 'setup_class'))
    return 0 if is_first else 2 if name in PREPARING else 1


def _run_later(machine: RosInterpreter, instance: Instance, name: str, method: Function) -> None:
    lifecycle = isinstance(instance.state, NodeState) and instance.state.lifecycle
    place = method.place

    def follow() -> None:
        world = machine.world
        world.when = When.CONFIGURE if lifecycle and name in TRANSITIONS else When.LATER
        world.shutting_down = is_closing(name)
        world.after_spin = False
        if world.when is When.LATER:
            world.path = (*instance.path, (place, UNCALLED))
        static = method.binding == 'static'
        call = unknown_arguments(method, place, skip=0 if static else 1)
        owner = begin_test(machine, instance) if is_test(name) else instance
        receiver = owner.cls if method.binding == 'class' else owner
        target: Value = method if static else Bound(receiver, method)
        result = machine.call(target, call)
        machine.run_if_coroutine(result, place)

    with _called_later(machine.world):
        guarded(machine, follow, place)
    if is_test(name):
        end_test(machine)
    machine.world.called[id(method.node)] = method
