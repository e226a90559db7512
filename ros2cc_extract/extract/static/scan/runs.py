"""Runs of the abstract machine: from an entry, over the callbacks, to what nobody calls."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from ros2cc_extract.extract.static.concurrency import activities
from ros2cc_extract.extract.static.concurrency.accesses.unreleased_locks import note_kept_locks
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.waits.unknown_waits import NAME as UNKNOWN_WAIT
from ros2cc_extract.extract.static.concurrency.waits.values_during_waits import show_to_callbacks
from ros2cc_extract.extract.static.libraries.rclpy.machine.held_by_callbacks import call_holding
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.called_by_services import (
    BUILDING,
    TRANSITIONS,
)
from ros2cc_extract.extract.static.libraries.standard.done_callbacks import add_left
from ros2cc_extract.extract.static.libraries.standard.exit_hooks import run_exit_hooks
from ros2cc_extract.extract.static.libraries.standard.queue_items import take_back
from ros2cc_extract.extract.static.program.call_order import (
    callers_first,
    leading_to_entities,
)
from ros2cc_extract.extract.static.program.entry_points import Entry
from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.program.relevance import creates_entities
from ros2cc_extract.extract.static.program.text_queries import is_test
from ros2cc_extract.extract.static.python.branching.open_tests import holds_objects
from ros2cc_extract.extract.static.python.language.plain_data_calls import leads_nowhere
from ros2cc_extract.extract.static.python.machine.fixed_point import next_round
from ros2cc_extract.extract.static.python.machine.frame import BudgetError
from ros2cc_extract.extract.static.python.machine.incomplete_runs import note_cut
from ros2cc_extract.extract.static.python.machine.recorded_deeds import Deeds
from ros2cc_extract.extract.static.python.machine.world import Cut
from ros2cc_extract.extract.static.python.objects.reanalysis import both
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.exclusive_paths import IN_A_CALLBACK
from ros2cc_extract.extract.static.python.values.unknown_callers import unknown_arguments
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Class,
    Function,
    Heaped,
    Instance,
    Mystery,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter
from ros2cc_extract.extract.static.scan.test_programs import PREPARING, begin_test, end_test
from ros2cc_extract.extract.static.scan.texts_that_act import may_make_entities, may_wait
from ros2cc_extract.extract.static.units.whole_program.double_spins import note_spun_twice
from ros2cc_extract.extract.static.units.whole_program.ends_while_served import note_ends
from ros2cc_extract.extract.static.units.whole_program.foreign_loop_calls import note_foreign_loops
from ros2cc_extract.extract.static.units.whole_program.nodes_taken_by_threads import (
    note_taken_by_threads,
)
from ros2cc_extract.extract.static.units.whole_program.taken_messages import note_taken
from ros2cc_extract.extract.static.units.whole_program.unanswered_waits import note_unanswered
from ros2cc_extract.places import Place, Unknown
from ros2cc_extract.spec.deeds import Blocking
from ros2cc_extract.spec.model import EntityKind, When

_PARAMETERS = {
    EntityKind.SUBSCRIPTION: 1,
    EntityKind.SERVICE: 2,
    EntityKind.ACTION_EXECUTE: 1,
    EntityKind.ACTION_SERVER: 1,
    EntityKind.ACTION_CLIENT: 1,
    EntityKind.DONE_CALLBACK: 1,
    EntityKind.PARAMETER_SERVICE: 1,
    EntityKind.LIFECYCLE_SERVICE: 1,
}

_DESTROYING = 'on_deactivate'
UNCALLED = -3
"""Step of a path that somebody who is not in sight takes."""

_CLOSING = ('destroy', 'shutdown', 'cleanup', 'close', 'stop', '__del__', '__exit__', 'on_error')
TOO_LONG = 'set-up is too long to be followed to its end'
_CALLBACK_LIMIT = 2_000
_ROUNDS = 2
STEP_LIMIT = 600_000
"""Statements and expressions of one set-up, callback or method; ``RUN_LIMIT`` holds for all."""


def run_entry(project: Project, entry: Entry) -> RosInterpreter:
    """Follow a program from one of its entries, then its callbacks."""
    machine = RosInterpreter(project)
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
    _run_escaped(machine)
    run_callbacks(machine)
    run_rest_of_instances(machine)
    take_back(machine.world)
    note_kept_locks(machine.world)
    note_unanswered(machine.world)
    note_spun_twice(machine.world)
    note_taken_by_threads(machine.world)
    note_taken(machine.world)
    note_ends(machine.world)
    note_foreign_loops(machine.world)
    return machine


def _run_escaped(machine: RosInterpreter) -> None:
    """Functions handed to code that is not scanned, such as the loop of another framework."""
    world = machine.world
    for value, place in world.escaped[:_CALLBACK_LIMIT]:
        inner = value
        while isinstance(inner, Partial):
            inner = inner.function
        function = inner.function if isinstance(inner, Bound) else inner
        if not isinstance(function, Function) or id(function.node) in world.called:
            continue
        if may_make_entities(world, function.node) or may_wait(world, function.node):
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

    guarded(machine, follow, place)


def guarded(
    machine: RosInterpreter, act: object, place: Place, text: ast.Module | None = None
) -> str:
    """
    Do ``act``; a program too large to be followed ends in a diagnostic.

    :param text: the file that is run; where it leads to nothing of ROS, nothing is missing.
    :returns: why it was not followed to its end; empty where it was.
    """
    world = machine.world
    if not machine.steps_left or _is_late(machine):
        reason = _why_cut(machine)
        if not any(cut.reason == reason for cut in world.cut):
            world.cut.append(Cut(reason, place))
        return reason
    why = ''
    machine.steps, machine.step_limit = 0, min(STEP_LIMIT, machine.steps_left)
    try:
        act()  # type: ignore[operator]
    except BudgetError:
        if world.nodes or text is None or not leads_nowhere(machine, text):
            why = _why_cut(machine)
    except RecursionError:
        why = 'set-up is nested too deeply to be followed'
    finally:
        machine.steps_left -= min(machine.steps, machine.steps_left)
        machine.stack.clear()
        machine.depth = 0
        world.path, world.count, world.chain, world.held = (), 1, (), ()
        world.stopped, world.deeds, world.current, world.looking = False, None, None, ()
        world.shutting_down = False
        world.in_thread, world.when, world.thread = False, When.START, 0
        world.activity, world.again, world.retelling = None, False, False
        machine.store.reset()
    if why:
        note_cut(world, place, why)
    return why


def _note_cut(deeds: Deeds, why: str, place: Place) -> None:
    """What was not followed may wait for anything."""
    wait = Blocking(call=UNKNOWN_WAIT, source=place, on=Unknown(why, place))
    if why and wait not in deeds.blocking:
        deeds.blocking.append(wait)


def _is_late(machine: RosInterpreter) -> bool:
    return machine.deadline is not None and machine.deadline.is_over


def _why_cut(machine: RosInterpreter) -> str:
    is_late = _is_late(machine) and machine.steps_left and machine.steps <= machine.step_limit
    return machine.deadline.reason if machine.deadline and is_late else TOO_LONG


@dataclass(frozen=True)
class _TooEarly:
    """A callback that was followed before others had set what it asked for."""

    entity: EntityState
    met_none: bool
    lacking: tuple[tuple[Heaped, str | None], ...]

    def may_go_on(self) -> bool:
        """True when it met ``None``, or lacked what somebody has set or put in since."""
        return self.met_none or any(_is_there(owner, name) for owner, name in self.lacking)


def _is_there(owner: Heaped, name: str | None) -> bool:
    return holds_objects(owner) if isinstance(owner, Collection) else name in owner.slots


def run_callbacks(machine: RosInterpreter) -> None:
    """
    Follow every callback, also of entities that callbacks make.

    Those that met ``None``, nothing, or a list without objects, where others put something are
    followed again after them, and once more for what they hand on to each other; and those that
    met an object where others put another one, as long as there are such.
    """
    show_to_callbacks(machine.world, machine.store)
    _run_all_callbacks(machine)
    if machine.world.left_callbacks:
        place = machine.world.left_callbacks[0].place
        guarded(machine, lambda: add_left(machine), place)
        _run_all_callbacks(machine)


def _run_all_callbacks(machine: RosInterpreter) -> None:
    _run_new_callbacks(machine)
    while again := next_round(machine.world, machine.world.entities):
        for entity in again:
            _run_again(machine, entity)
        _run_new_callbacks(machine)
    for state in activities.followed(machine.world):
        _tell(machine, state)
        _run_new_callbacks(machine)
    for state in machine.world.signal_handlers:
        _tell(machine, state)


def _run_new_callbacks(machine: RosInterpreter) -> None:
    """Follow new entities, and functions that callbacks have given to others since."""
    _run_new_entities(machine)
    while late := [
        each for each in machine.world.entities if 0 <= each.ran < len(_functions(each))
    ]:
        for entity in late:
            for callback in _functions(entity)[entity.ran :]:
                entity.ran += 1
                _run_callback(machine, entity, callback, entity.deeds or Deeds(), again=False)
        _run_new_entities(machine)


def _functions(entity: EntityState) -> tuple[Value, ...]:
    given = (entity.callback, *entity.extra_callbacks)
    return tuple(callback for callback in given if callback is not None)


def _run_new_entities(machine: RosInterpreter) -> None:
    world, too_early = machine.world, list[_TooEarly]()
    while world.followed < min(len(world.entities), _CALLBACK_LIMIT):
        entity = world.entities[world.followed]
        world.followed += 1
        unset, world.lacking = world.unset, []
        _run_callbacks_of(machine, entity)
        if world.unset != unset or world.lacking:
            too_early.append(_TooEarly(entity, world.unset != unset, tuple(world.lacking)))
        if world.followed == len(world.entities):
            again, too_early = [one.entity for one in too_early if one.may_go_on()], []
            for entity in again * _ROUNDS:
                _run_again(machine, entity)


def _tell(machine: RosInterpreter, state: ActivityState) -> None:
    """Follow what a thread does beside the callbacks."""

    def follow() -> None:
        activities.begin_telling(machine.world, state)
        mark = machine.store.open_branch()
        call = state.call or Call(state.place)
        for option in options_of(state.target) if state.target is not None else ():
            machine.run_if_coroutine(machine.call(option, call), state.place)
        _end_branch(machine, mark)

    _note_cut(state.deeds, guarded(machine, follow, state.place), state.place)


def _end_branch(machine: RosInterpreter, mark: int) -> None:
    """Join what was written with what held before, and with what others met meanwhile."""
    written = machine.store.close_branch(mark)
    machine.store.join([written, {}, *machine.store.take_shown()])


def _run_again(machine: RosInterpreter, entity: EntityState) -> None:
    before = entity.deeds or Deeds()
    entity.deeds = both(before, _run_callbacks_of(machine, entity, again=True))


def _run_callbacks_of(
    machine: RosInterpreter, entity: EntityState, *, again: bool = False
) -> Deeds:
    entity.deeds = Deeds()
    machine.world.met = machine.world.met_by[id(entity)] = {}
    functions = _functions(entity)
    entity.ran = len(functions)
    for callback in functions:
        _run_callback(machine, entity, callback, entity.deeds, again=again)
    return entity.deeds


def _run_callback(
    machine: RosInterpreter, entity: EntityState, callback: Value, deeds: Deeds, *, again: bool
) -> None:
    def follow() -> None:
        world = machine.world
        world.again, world.asked, world.ready = again, set(), frozenset()
        world.deeds, world.current, world.after_spin = deeds, entity, False
        transition = _transition_of(entity, callback)
        if transition:
            world.when, world.shutting_down = When.CONFIGURE, _is_closing(transition)
        else:
            world.when = When.CALLBACK
            world.count = Unknown('made each time the callback runs', entity.place)
            world.path = ((entity.place, IN_A_CALLBACK),)
        world.callback_path = world.path
        mark = None if transition in BUILDING else machine.store.open_branch()
        call = Call(entity.place, _callback_arguments(entity))
        for option in options_of(callback):
            call_holding(machine, entity, option, call)
        if mark is not None:
            _end_branch(machine, mark)

    _note_cut(deeds, guarded(machine, follow, entity.place), entity.place)


def _transition_of(entity: EntityState, callback: Value) -> str:
    """The transition that a callback is; it is made once for each node, as set-up is."""
    is_one = entity.kind is EntityKind.LIFECYCLE_SERVICE and isinstance(callback, Bound)
    return callback.function.name if is_one and isinstance(callback, Bound) else ''


def _is_closing(name: str) -> bool:
    return any(word in name for word in _CLOSING)


def _callback_arguments(entity: EntityState) -> list[Value]:
    if entity.argument is not None:
        return [entity.argument]
    return [
        Mystery(Unknown('argument of a callback', entity.place), '')
        for _ in range(_PARAMETERS.get(entity.kind, 0))
    ]


def run_rest_of_instances(machine: RosInterpreter) -> None:
    """Methods that make entities and that nobody in sight calls; they may be called later."""
    seen = 0
    while seen < min(len(machine.world.instances), _CALLBACK_LIMIT):
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
    Whether nobody in sight calls it.

    It is followed for each object that the set-up makes, and once for others of its class; one
    that only the class itself is to call once as well, whatever keeps the class from it.
    """
    number = id(method.text.node)
    is_of_set_up = all(step != UNCALLED for _, step in instance.path)
    followed = world.without_caller.get(number, set())
    is_other = bool(followed) and id(instance) not in followed and is_of_set_up
    is_private = method.is_hidden or method.name.startswith('_')
    return number not in world.called or (is_other and not is_private)


def _methods_without_caller(machine: RosInterpreter, instance: Instance) -> list[_Method]:
    """
    Methods not followed yet that lead to entities, callers before what they call.

    Using a scanned class or function that makes some leads to entities too.
    """
    left = [
        method
        for method in _methods_of(machine, instance)
        if _lacks_caller(machine.world, method, instance)
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
    wanted = leading_to_entities(names, nodes, makers, or_wait=True)
    if isinstance(instance.state, NodeState) and instance.state.lifecycle:
        wanted |= {_DESTROYING}
    return [method for method in callers_first(left, names, nodes) if method.name in wanted]


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
        world.shutting_down = _is_closing(name)
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

    guarded(machine, follow, place)
    if is_test(name):
        end_test(machine)
    machine.world.called[id(method.node)] = method
