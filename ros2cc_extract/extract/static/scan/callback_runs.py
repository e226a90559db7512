"""Callbacks and threads, each followed by itself until nothing new is met."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency import activities
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.waits.values_during_waits import show_to_callbacks
from ros2cc_extract.extract.static.libraries.rclpy.machine.inherited_locks import call_holding
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.called_by_services import (
    BUILDING,
)
from ros2cc_extract.extract.static.libraries.standard import signal_handlers
from ros2cc_extract.extract.static.libraries.standard.done_callbacks import add_left
from ros2cc_extract.extract.static.python.branching.open_tests import holds_objects
from ros2cc_extract.extract.static.python.machine.fixed_point import next_round
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.objects.reanalysis import both
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.exclusive_paths import IN_A_CALLBACK
from ros2cc_extract.extract.static.python.values.values import (
    OF_CALLBACK,
    Bound,
    Call,
    Heaped,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.scan.guarded_runs import guarded, note_cut_run
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter
from ros2cc_extract.extract.static.scan.unfit_callbacks import is_unfit
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
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

_CLOSING = ('destroy', 'shutdown', 'cleanup', 'close', 'stop', '__del__', '__exit__', 'on_error')

_ROUNDS = 2

MOST_CALLBACKS = 2_000


@dataclass(frozen=True)
class _TooEarly:
    """A callback that was followed before others had set what it asked for."""

    entity: EntityState
    met_none: bool
    lacking: tuple[tuple[Heaped, str | None], ...]

    def may_go_on(self) -> bool:
        """True when it met ``None``, or lacked what was set or put in since."""
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
        _follow(machine, state)
        _run_new_callbacks(machine)
    for state in machine.world.signal_handlers:
        _follow(machine, state)
        signal_handlers.note_followed(machine.world, state)


def _run_new_callbacks(machine: RosInterpreter) -> None:
    """Follow new entities, and functions that callbacks have given to others since."""
    _run_new_entities(machine)
    while late := [
        each for each in machine.world.entities if 0 <= each.ran < len(_functions(each))
    ]:
        for entity in late:
            for callback in _functions(entity)[entity.ran :]:
                entity.ran += 1
                _run_callback(
                    machine, entity, callback, entity.effects or EffectLog(), again=False
                )
        _run_new_entities(machine)


def _functions(entity: EntityState) -> tuple[Value, ...]:
    given = (entity.callback, *entity.extra_callbacks)
    return tuple(callback for callback in given if callback is not None)


def _run_new_entities(machine: RosInterpreter) -> None:
    world, too_early = machine.world, list[_TooEarly]()
    while world.followed < min(len(world.entities), MOST_CALLBACKS):
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


def _follow(machine: RosInterpreter, state: ActivityState) -> None:
    """Follow what a thread does beside the callbacks."""

    def follow() -> None:
        activities.begin_second_pass(machine.world, state)
        mark = machine.store.open_branch()
        call = state.call or Call(state.place)
        for option in options_of(state.target) if state.target is not None else ():
            machine.run_if_coroutine(machine.call(option, call), state.place)
        _end_branch(machine, mark)

    note_cut_run(state.effects, guarded(machine, follow, state.place), state.place)


def _end_branch(machine: RosInterpreter, mark: int) -> None:
    """Join what was written with what held before, and with what others met meanwhile."""
    written = machine.store.close_branch(mark)
    machine.store.join([written, {}, *machine.store.take_shown()])


def _run_again(machine: RosInterpreter, entity: EntityState) -> None:
    before = entity.effects or EffectLog()
    entity.effects = both(before, _run_callbacks_of(machine, entity, again=True))


def _run_callbacks_of(
    machine: RosInterpreter, entity: EntityState, *, again: bool = False
) -> EffectLog:
    if entity.is_set_up and entity.effects is not None:
        return entity.effects
    entity.effects = EffectLog()
    machine.world.met = machine.world.met_by[id(entity)] = {}
    functions = _functions(entity)
    entity.ran = len(functions)
    for callback in functions:
        _run_callback(machine, entity, callback, entity.effects, again=again)
    return entity.effects


def run_once_more(machine: RosInterpreter, entity: EntityState) -> EffectLog:
    """What a callback does when it is followed from what is stored now."""
    log = EffectLog()
    for callback in _functions(entity):
        _run_callback(machine, entity, callback, log, again=True)
    return log


def _run_callback(
    machine: RosInterpreter,
    entity: EntityState,
    callback: Value,
    effects: EffectLog,
    *,
    again: bool,
) -> None:
    def follow() -> None:
        world = machine.world
        world.again, world.asked, world.ready = again, set(), frozenset()
        world.effects, world.current, world.after_spin = effects, entity, False
        transition = _transition_of(entity, callback)
        if transition:
            world.when, world.shutting_down = When.CONFIGURE, is_closing(transition)
        else:
            world.when = When.CALLBACK
            world.count = Unknown('made each time the callback runs', entity.place)
            world.path = ((entity.place, IN_A_CALLBACK),)
        world.callback_path = world.path
        # What the program has built by its own transitions is there beside what these build anew.
        builds = transition in BUILDING and not entity.node.state.changes_own_state
        mark = None if builds else machine.store.open_branch()
        call = Call(entity.place, _callback_arguments(entity))
        for option in options_of(callback):
            if not is_unfit(machine, entity, option):
                call_holding(machine, entity, option, call)
        if mark is not None:
            _end_branch(machine, mark)

    note_cut_run(effects, guarded(machine, follow, entity.place), entity.place)


def _transition_of(entity: EntityState, callback: Value) -> str:
    """The transition that a callback is; it is made once for each node, as set-up is."""
    is_one = entity.kind is EntityKind.LIFECYCLE_SERVICE and isinstance(callback, Bound)
    return callback.function.name if is_one and isinstance(callback, Bound) else ''


def is_closing(name: str) -> bool:
    """Whether a method is called like one that takes things down."""
    return any(word in name for word in _CLOSING)


def _callback_arguments(entity: EntityState) -> list[Value]:
    if entity.argument is not None:
        return [entity.argument]
    return [
        Mystery(Unknown(OF_CALLBACK, entity.place), '')
        for _ in range(_PARAMETERS.get(entity.kind, 0))
    ]
