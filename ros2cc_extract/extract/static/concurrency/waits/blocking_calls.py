"""What may hold a thread while it is followed, and what ends the waits of others."""

from __future__ import annotations

import ast
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.accesses import lost_notifications
from ros2cc_extract.extract.static.concurrency.accesses.held_locks import held_over
from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import (
    ActivityState,
    ConcurrentWorld,
    is_in_process,
)
from ros2cc_extract.extract.static.concurrency.machine.wait_table import (
    NO_ROW,
    SPIN_UNTIL,
    WaitRow,
)
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    DataRef,
    EntityRef,
    MessageRef,
    ResourceRef,
    SettableRef,
    TopicRef,
    Waking,
)
from ros2cc_extract.extract.static.concurrency.waits import (
    cleared_events,
    outside_waits,
    values_during_waits,
)
from ros2cc_extract.extract.static.concurrency.waits.rounds import note_round
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import waking_of
from ros2cc_extract.extract.static.concurrency.waits.unknown_waits import (
    timeout_of,
    unknown_wait,
    wait_of_one,
)
from ros2cc_extract.extract.static.concurrency.waits.waiting_loops import is_endless, kept_by
from ros2cc_extract.extract.static.python.branching.parameter_branches import only_if
from ros2cc_extract.extract.static.python.machine.library_state import LibraryState, PlainState
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import (
    Doer,
    EffectLog,
    way_of,
)
from ros2cc_extract.extract.static.python.machine.waitable_objects import (
    INITIAL,
    SETTABLE,
    is_of_loop,
)
from ros2cc_extract.extract.static.python.machine.world import RECENT
from ros2cc_extract.extract.static.python.values.assumed_defaults import default_of
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Coroutine,
    Instance,
    Library,
    Mystery,
    Path,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import AWAIT, PAUSES, TURN, UNKNOWN_WAIT, Blocking, Needs
from ros2cc_extract.spec.model import ActivityKind, When


class Waits(ConcurrentMachine):
    """Notes for the callback or activity that is being followed."""

    def note_endless(self, node: ast.While, place: Place) -> None:
        """A loop was followed that nothing but the end of the program ends."""
        world = self.world
        is_followed = world.activity is not None and world.effects is not None
        if is_followed and is_endless(node) and world.path == world.callback_path:
            state = world.activity
            assert state is not None
            state.loops = True
            state.endless, state.until_shutdown = kept_by(node, place)

    def note_blocking(
        self, name: str, on: Value | None, seconds: Value | None, place: Place
    ) -> None:
        """A call that can hold its thread."""
        world, effects = self.world, self.world.effects
        if seconds in (None, NONE) and name.startswith(AWAIT):
            seconds = world.limit
        row: WaitRow = self.model.waits.get(name, NO_ROW)
        is_ready = row.unless_asked and world.is_ready(on, row.ended_by)
        if is_ready and row.rival is None:
            return
        if effects is None or is_main(world.activity):
            self._note_outside(name, on, seconds, place)
            outside_waits.note_interruptible(world, name, on)
        is_unnamed = isinstance(on, Instance) and on.hint is None
        if world.is_set_up_on_loop or (is_unnamed and is_main(world.activity)):
            outside_waits.note_cancelled(world, name, on)
        if seconds in (None, NONE):
            outside_waits.note_served(world, name, on, place)
        block, thing = self._block(name, on, seconds, place)
        if effects is None:
            values_during_waits.note_met(world, thing)
            self._note_in_set_up(block, thing, place)
            return
        if is_main(world.activity):
            self._note_in_set_up(block, thing, place)
        touch(world.activity, thing)
        if thing is not None:
            self.store.show(thing)
        world.note_waited(way_of(block))
        if world.open_loops:
            effects.looped.add(way_of(block))
        sure = tuple(number for number in world.round if number > 0)
        current = world.round if name in PAUSES else sure
        note_round(effects, block, current, is_open=world.open_loops > 0)
        effects.note_way(block, world.path)

    def _block(
        self, name: str, on: Value | None, seconds: Value | None, place: Place
    ) -> tuple[Blocking, Instance | None]:
        """The wait, with references to what it waits on, and the one object that this is."""
        world = self.world
        row: WaitRow = self.model.waits.get(name, NO_ROW)
        is_ready = row.unless_asked and world.is_ready(on, row.ended_by)
        thing, why = _one_object(on, place)
        block = Blocking(
            call=name,
            source=place,
            on=self._waited_for(on if thing is None or why is not None else thing),
            seconds=_seconds(seconds, place),
            assumed=self._assumed_seconds(seconds),
            chain=world.chain[1:],
            held=held_over(world, on),
            resource=self._resource(name, thing, row, asked=is_ready),
            needs=row.needs,
            escapes=why if row is not NO_ROW else None,
            conditional=world.path != world.callback_path,
            only_if=only_if(world),
            repeats=_is_in_a_loop_of_a_hold(world),
            times=world.times,
            or_more=(world.times > 1 or name in PAUSES) and world.open_loops > 0,
            caught=seconds is not None and _is_caught(row.raises, world),
        )
        return block, thing

    def _assumed_seconds(self, value: Value | None) -> str | None:
        if not isinstance(value, Mystery) or _default_seconds(value) is None:
            return None
        return self.assumption('duration', value)

    def note_loop_on_data(
        self,
        name: str,
        on: DataRef | MessageRef | Unknown,
        seconds: Unknown | None,
        place: Place,
        spun: tuple[Instance, ...] = (),
    ) -> None:
        """A loop goes on until other code has written what its test reads."""
        world, effects = self.world, self.world.effects
        block = Blocking(
            call=name,
            source=place,
            on=on,
            seconds=seconds,
            chain=world.chain[1:],
            held=held_over(world, None),
            resource=None if isinstance(on, Unknown) else on,
            escapes=on if isinstance(on, Unknown) else None,
            conditional=world.path != world.callback_path,
        )
        if effects is None:
            self._note_in_set_up(block, None, place, spun)
            return
        if is_main(world.activity):
            self._note_in_set_up(block, None, place, spun)
        world.note_waited(way_of(block))
        effects.note_way(block, world.path)
        if block not in effects.blocking[-RECENT:]:
            effects.blocking.append(block)
        effects.met.append((len(effects.blocking) - 1, 0))

    def note_unknown_call(self, function: Mystery, call: Call) -> None:
        """Something that could not be followed is called, perhaps by the name of a wait."""
        waking = waking_of(call.text)
        if waking is not None:
            places = self.world.lost_wakes.setdefault(waking, [])
            if call.place not in places:
                places.append(call.place)
        if self.note_clock_call(call):
            return
        why = wait_of_one(self.world, function) or unknown_wait(function, call, self.world.trees)
        if why is not None:
            self.note_blocking(UNKNOWN_WAIT, Mystery(why), timeout_of(call), call.place)

    def note_clock_call(self, call: Call) -> bool:
        """Whether the method of an unknown object is one that only clocks have, which wait."""
        return False

    def _resource(
        self, name: str, thing: Instance | None, row: WaitRow, *, asked: bool
    ) -> ResourceRef | None:
        if thing is None or not row.ended_by or _is_of_entity(thing):
            return None
        reference = ResourceRef(thing.hint or thing.class_name)
        reference.number = id(thing)
        reference.ended_by = row.ended_by
        reference.asked = asked
        reference.is_kept = row.needs is Needs.ONCE
        if self.world.effects is not None:
            cleared_events.begin_wait(reference, self.world.effects, thing)
        reference.initial = _initial(thing, row)
        reference.made, reference.is_own = thing.place, thing.born is not None
        if Word.ARRIVE in row.ended_by:
            reference.parties = _number(thing.slots.get(INITIAL))
        reference.like = self._made_there(thing)
        if name in lost_notifications.CONDITION_WAITS:
            reference.guard = lost_notifications.guard_of(self.world, thing)
        return reference

    def _made_there(self, thing: Instance) -> list[int]:
        """Identities of what was made where ``thing`` was made, itself among them."""
        alike = self.world.made_at.setdefault((thing.cls, thing.place), [])
        if id(thing) not in alike:
            alike.append(id(thing))
            self.world.kept.append(thing)
        return alike

    def note_outside_wait(
        self,
        name: str,
        on: Value | None,
        seconds: Value | None,
        place: Place,
        spun: tuple[Instance, ...] = (),
    ) -> None:
        """Code that is no callback waits for ``on`` and spins some nodes meanwhile."""
        self._note_outside(name, on, seconds, place, spun)
        if on is not None and (self.world.effects is None or is_main(self.world.activity)):
            call = name if name in self.model.waits else SPIN_UNTIL
            block, thing = self._block(call, on, seconds, place)
            values_during_waits.note_met(self.world, thing)
            self._note_in_set_up(block, thing, place, spun)

    def _note_in_set_up(
        self,
        block: Blocking,
        thing: Instance | None,
        place: Place,
        spun: tuple[Instance, ...] = (),
    ) -> None:
        caller = self.stack[0].name if self.stack else ''
        outside_waits.note_in_set_up(self.world, block, thing, place, spun, caller)

    def _note_outside(
        self,
        name: str,
        on: Value | None,
        seconds: Value | None,
        place: Place,
        spun: tuple[Instance, ...] = (),
    ) -> None:
        if isinstance(on, Instance) and seconds in (None, NONE):
            outside_waits.note(self.world, name, on, place, spun)

    def _waited_for(self, value: Value | None) -> str | Unknown | None:
        if value is None or value == NONE:
            return None
        if isinstance(value, Mystery):
            return value.unknown
        if isinstance(value, Instance):
            state = value.state
            source = state.of if isinstance(state, PlainState) and state.of else value
            if isinstance(source, Instance) and isinstance(source.state, Doer):
                return EntityRef.to_object(source.state, source.state.kind_name)
            if isinstance(state, PlainState) and state.kind == 'topic':
                return _topic(state.key, value.place)
            if isinstance(state, PlainState) and state.kind in SETTABLE:
                return SettableRef.to_object(value, value.hint or value.class_name)
            if isinstance(value.state, LibraryState) and value.state.is_unit_of_its_own:
                return EntityRef.to_object(value, value.hint or value.class_name)
            return value.hint or value.class_name
        return None

    def note_await(self, value: Value, place: Place) -> None:
        """A callback awaits ``value``; awaiting its own coroutine is only a call."""
        if is_of_loop(value):
            self.world.awaited_of_loops.append(value)
        if self.world.current is not None and self.world.current.is_on_loop:
            outside_waits.note_in_loop(self.world, value, place)
        if not isinstance(value, (Coroutine, Const)):
            self.note_blocking(
                'asyncio await' if self.world.on_loop else 'await', value, None, place
            )

    def note_turn(self, place: Place) -> None:
        """A coroutine lets the executor run others and goes on by itself."""
        if self.world.effects is not None and self.world.in_callback:
            self.note_blocking(TURN, None, Const(0), place)

    def note_wake(self, thing: Value, word: Word, place: Place, item: Value | None = None) -> None:
        """Something is done to ``thing`` that may end a wait for it."""
        world = self.world
        activity = world.activity
        if activity is not None and world.effects is None and not activity.is_executor:
            activity.wakes.append((thing, word, place, item))  # it may be followed once more
            return
        for option in options_of(thing):
            if is_in_process(activity) and is_of_one_process(option):
                continue
            cleared_events.note_given(world.effects, option, lost_notifications.holds_of(world))
            if world.effects is not None:
                world.effects.woken.setdefault(id(option), len(world.effects.blocking))
            wakings = world.wakings.setdefault(id(option), [])
            waking = self._waking(option, word, place, item)
            same = next((n for n, w in enumerate(wakings) if _is_same_waking(waking, w)), None)
            if same is not None:
                wakings[same] = _with_item(wakings[same], item, world.path)
            else:
                wakings.append(waking)
                if isinstance(option, Instance):
                    self._made_there(option)
            touch(world.activity, option)

    def _waking(self, thing: Value, word: Word, place: Place, item: Value | None) -> Waking:
        world = self.world
        doer = world.activity or (world.current if world.effects is not None else None)
        is_uncalled = doer is None and world.when is When.LATER
        return Waking(
            word,
            doer,
            place,
            behind=world.effects.behind if world.effects is not None else None,
            conditional=world.path != world.callback_path if doer else bool(world.path),
            path=world.path,
            after_spin=world.after_spin,
            spins=0 if world.spun_in_loop else world.main_spins,
            uncalled=(self.stack[0].name if self.stack else '') if is_uncalled else None,
            held=held_over(world, thing),
            is_counted=not world.path and world.count == 1,
            left=world.left_before(),
            in_loop=world.open_loops > 0,
            unless_done=doer is not None and _only_unless_done(world, thing, word),
            repeats=bool(world.reading.loops),
            written=frozenset(access.name for access in (world.effects or EffectLog()).writes),
            holds=lost_notifications.holds_of(world),
            item=item,
            taken=tuple(world.effects.taken) if world.effects is not None else (),
            ended=frozenset() if doer else outside_waits.ended_by(world),
        )


def _is_in_a_loop_of_a_hold(world: ConcurrentWorld) -> bool:
    loops = world.open_loops
    return any(loops > world.loops_at.get(lock, loops) for lock in world.held)


def _only_unless_done(world: ConcurrentWorld, thing: Value, word: Word) -> bool:
    """Whether no branch skips what is done to ``thing`` but where it has been done before."""
    more = world.path[len(world.callback_path) :]
    return all((thing, word) in world.skipped_if.get(step, ()) for step in more)


def _topic(name: Value | None, place: Place) -> TopicRef | Unknown:
    if isinstance(name, Const) and isinstance(name.value, str):
        return TopicRef(name.value)
    unknown = Unknown('topic that could not be followed', place)
    return name.unknown if isinstance(name, Mystery) else unknown


def is_main(activity: ActivityState | None) -> bool:
    return activity is not None and activity.kind is ActivityKind.MAIN


def is_of_one_process(thing: Value) -> bool:
    """An event, a lock, a queue … that each process has one of its own of."""
    if not isinstance(thing, Instance) or not isinstance(thing.state, PlainState):
        return False
    cls = next((cls for cls in thing.mro if isinstance(cls, Library)), None)
    return cls is not None and cls.name.startswith(('threading.', 'queue.'))


def _one_object(on: Value | None, place: Place) -> tuple[Instance | None, Unknown | None]:
    """The one object that is waited on, or why it is not known which one that is."""
    options = [option for option in options_of(on) if option != NONE] if on is not None else []
    things = [option for option in options if isinstance(option, Instance)]
    if len(things) == 1 and len(options) == 1:
        return things[0], None
    if len(things) > 1 and len(things) == len(options):
        return None, Unknown('one of several objects, depending on a branch', place)
    unknown = next((option.unknown for option in options if isinstance(option, Mystery)), None)
    return (things[0] if len(things) == 1 else None), unknown


def _initial(thing: Instance, row: WaitRow) -> int | None:
    """How many waits end by themselves: the value of a semaphore, the room in a queue."""
    if row.rival is not Word.PUT and Word.RELEASE not in row.ended_by:
        return 0
    return _number(thing.slots.get(INITIAL))


def _number(value: object) -> int | None:
    number = value.value if isinstance(value, Const) else None
    return number if isinstance(number, int) else None


"""What holds its thread longer where a loop may go round more often."""


def _is_of_entity(thing: Instance) -> bool:
    """Whether an entity of a node ends it, as the client of a request does."""
    of = thing.state.of if isinstance(thing.state, PlainState) else thing
    return isinstance(of, Instance) and isinstance(of.state, Doer)


def touch(activity: ActivityState | None, thing: Value | None) -> None:
    """An activity belongs to the nodes of what it touches."""
    if activity is None or not isinstance(thing, Instance):
        return
    state = thing.state
    of = state.of if isinstance(state, PlainState) and state.of is not None else thing
    if isinstance(of, Instance) and isinstance(of.state, LibraryState):
        owner = of.state.owner_of(of)
        if owner is not None:
            activity.nodes.add(id(owner))
    activity.things.add(id(thing))


def _is_same_waking(one: Waking, other: Waking) -> bool:
    return (
        one.word is other.word
        and one.by is other.by
        and one.place == other.place
        and one.uncalled == other.uncalled
    )


def _with_item(waking: Waking, item: Value | None, path: Path) -> Waking:
    """The same operation on another way perhaps, in which another item may be put as well."""
    if path != waking.path:
        waking = replace(waking, path=None)
    if item is None or waking.item is None or item == waking.item:
        return waking
    options = dict.fromkeys((*options_of(waking.item), *options_of(item)))
    return replace(waking, item=choice(list(options)))


def _is_caught(raised: type[Exception] | None, world: ConcurrentWorld) -> bool:
    """Whether a ``try`` around catches an exception, by the name of one of its classes."""
    classes = {each.__name__ for each in raised.__mro__} if raised else set()
    return any(not classes.isdisjoint(names) for names in world.caught)


def _seconds(value: Value | None, place: Place) -> float | Unknown | None:
    if value is None or value == NONE:
        return None
    if isinstance(value, Const) and isinstance(value.value, (int, float)):
        return float(value.value)
    if isinstance(value, Mystery):
        default = _default_seconds(value)
        return value.unknown if default is None else default
    return Unknown('a duration that could not be followed', place)


def _default_seconds(value: Mystery) -> float | None:
    """A duration that is the default of a parameter."""
    default = default_of(value)
    known = default.value if isinstance(default, Const) else None
    if not isinstance(known, (int, float)) or isinstance(known, bool):
        return None
    return float(known) if known >= 0 else None
