"""The waits of one unit: what each waits on, and what may end it, by the names of the unit."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.activities import is_activity
from ros2cc_extract.extract.static.concurrency.machine.counters import MOST
from ros2cc_extract.extract.static.concurrency.machine.outside_names import OF_CHILDREN
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wait_table import NO_ROW, TAKES_PERMIT
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    DataRef,
    EntityRef,
    MessageRef,
    ResourceRef,
    SettableRef,
    TopicRef,
    Waking,
)
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
    is_handed_over,
    uncalled_wakers,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import End, EntityState, RosWorld
from ros2cc_extract.extract.static.libraries.rclpy.machine.waits import WAITS
from ros2cc_extract.extract.static.libraries.standard.pool_tasks import why_no_thread
from ros2cc_extract.extract.static.libraries.standard.processes import child_pipes
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.extract.static.units.wakers import barriers, initial_permits
from ros2cc_extract.extract.static.units.wakers.data_writers import DataWriters, Doer, Kept
from ros2cc_extract.extract.static.units.wakers.endless_threads import (
    is_never_left,
    may_not_come,
    never_comes,
    unknown_rounds,
    why_no_end,
    why_uneven,
)
from ros2cc_extract.extract.static.units.wakers.late_offers import offered_late
from ros2cc_extract.extract.static.units.wakers.lost_events import (
    answer_from_outside,
    sent_before_clear,
    why_early,
    why_wiped_out,
)
from ros2cc_extract.extract.static.units.wakers.mutual_exclusion import keeps_to_itself
from ros2cc_extract.extract.static.units.wakers.obstructed_wakers import is_kept_out
from ros2cc_extract.extract.static.units.wakers.operations import (
    as_unsure,
    by_interruption,
    comes_last,
    ended_last,
    ends_by_itself,
    is_in_turn,
    wakings_of,
    why_no_item,
    why_none,
)
from ros2cc_extract.extract.static.units.wakers.queue_consumers import (
    may_find_it_done,
    taken_by_itself,
)
from ros2cc_extract.extract.static.units.wakers.set_up_wakers import (
    ends_for_good,
    is_of_set_up,
    why_open,
)
from ros2cc_extract.extract.static.units.wakers.spins_aside import of_spin_aside
from ros2cc_extract.extract.static.units.wakers.uncertain_wakers import (
    forgets,
    is_unheard,
    unless_cancelled,
    why_gone,
    why_in_another_run,
    why_lost,
    why_not_there,
    why_unspun,
)
from ros2cc_extract.extract.static.units.wakers.unique_waker import the_setter, waited_name
from ros2cc_extract.extract.static.units.wakers.unsendable_messages import (
    comes_unasked,
    is_first,
    sent_in_hold,
    unsent_before_end,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import (
    BY_ITSELF,
    OUTSIDE,
    POLLING_LOOP,
    TIME,
    Blocking,
    Waker,
)
from ros2cc_extract.spec.model import ActivityKind

_THERE = 'what the loop asks for is perhaps there at first'
_OF_FORK = 'a child of os.fork may wait for a lock that another thread held then'
# What is waited for of one object may be several things.
_PARTS = {Word.GET: ' (room)', Word.DONE: ' (tasks done)'}
_LAST = ' (the item that ends the loop)'


class UnitWaits(DataWriters):
    """
    Names what the callbacks and activities of a unit wait for.

    :param names: of entities, activities, nodes and the executor, by their identity.
    """

    def __init__(self, world: RosWorld, names: dict[int, str], doers: Iterable[Doer]) -> None:
        super().__init__(world, names, tuple(doers))
        self._resources: dict[object, str] = {}
        self._taken: dict[str, int] = {}
        self._settled = dict(names)
        for number, wakings in world.wakings.items():
            setter = the_setter(wakings)
            if setter is not None and id(setter) in names:
                self._settled[number] = names[id(setter)]
        self.rounds = unknown_rounds(world)
        self._kept = {id(doer): self._keep(doer) for doer in self._doers}

    def of(self, doer: Doer) -> tuple[Blocking, ...]:
        """The waits of ``doer``."""
        kept = self._kept[id(doer)]
        waits = (self._with_wakers(*pair, doer) for pair in zip(kept.raw, kept.named, strict=True))
        return tuple(unless_cancelled(wait, doer, self._world) for wait in waits)

    def of_set_up(self, raws: list[Blocking]) -> tuple[tuple[Blocking, Blocking], ...]:
        """Waits of code that no callback runs, each as it was met and as it is in the unit."""
        doer = ActivityState(ActivityKind.MAIN, Place(''), effects=EffectLog(blocking=raws))
        kept = self._kept[id(doer)] = self._keep(doer)
        named = self.of(doer)
        del self._kept[id(doer)]
        return tuple(zip(kept.raw, named, strict=True))

    def _keep(self, doer: Doer) -> Kept:
        """Waits for one of several that have no name here are alike."""
        kept = Kept()
        for raw in (doer.effects or EffectLog()).blocking:
            if not self._is_none(raw, doer) and not self._gives_back(raw, doer):
                named = self._named(raw)
                if named not in kept.named:
                    kept.raw.append(raw)
                    kept.named.append(named)
                kept.places[way_of(raw)] = kept.named.index(named) + 1
            else:
                kept.places[way_of(raw)] = len(kept.named)
        return kept

    def _is_none(self, raw: Blocking, doer: Doer) -> bool:
        """
        Whether it never waits: it was asked before, and no other code changes the answer.

        Nor for what is never put in: it is never found there.
        """
        reference = raw.resource
        if not isinstance(reference, ResourceRef):
            return False
        if not reference.asked:
            return initial_permits.has_room(reference, wakings_of(self._world, reference))
        rival = WAITS[raw.call].rival
        if rival is None:
            return True
        wakings = wakings_of(self._world, reference)
        mine = [waking for waking in wakings if waking.word in reference.ended_by]
        is_in_sight = reference.number not in self._world.kept_inside
        is_empty = is_in_sight and not mine and self._initial(reference, wakings) == 0
        if is_empty and self._why_others(mine, reference) is None:
            return True
        takers = {id(waking.by): waking.by for waking in wakings if waking.word is rival}
        return len(takers) < 2 or keeps_to_itself(doer, takers.values())

    def _gives_back(self, raw: Blocking, doer: Doer) -> bool:
        """Whether code that takes a semaphore gives it back too, so that it is a lock."""
        reference = raw.resource
        if raw.call not in TAKES_PERMIT or not isinstance(reference, ResourceRef):
            return False
        wakings = wakings_of(self._world, reference)
        given = [waking for waking in wakings if waking.word is Word.RELEASE]
        initial = self._initial(reference, given)
        return initial != 0 and initial_permits.is_plain_lock(raw, doer, self._doers, given)

    def _named(self, raw: Blocking) -> Blocking:
        resource = raw.resource
        if isinstance(raw.on, DataRef):
            return replace(raw, on=self._the_writer(raw.on), resource=str(raw.on))
        if isinstance(raw.on, TopicRef):
            return replace(raw, on=str(raw.on), resource=str(raw.on))
        if isinstance(raw.on, MessageRef):
            return replace(raw, on=self._names.get(raw.on.number), resource=str(raw.on))
        on = waited_name(raw.on, self._settled)
        if isinstance(resource, ResourceRef):
            on = self._the_waker(raw, resource) or (str(raw.on) if on is not None else None)
        if isinstance(resource, ResourceRef):
            resource = self._resource(resource)
        elif isinstance(raw.on, EntityRef) and isinstance(on, str):
            resource = on
        return replace(raw, on=on, foreign=self._is_foreign(raw.on), resource=resource)

    def _the_waker(self, raw: Blocking, reference: ResourceRef) -> str | None:
        """The one callback that ends a wait, where nothing else can."""
        wakings = wakings_of(self._world, reference)
        setter = the_setter(wakings, reference.ended_by)
        mine = [waking for waking in wakings if waking.word in reference.ended_by]
        is_open = raw.escapes is not None or self._why_open(mine, reference) is not None
        is_open = is_open or self._initial(reference, mine) != 0
        return None if setter is None or is_open else self._names.get(id(setter))

    def _resource(self, reference: ResourceRef) -> str:
        key = (reference.number, reference.ended_by, reference.until)
        known = self._resources.get(key)
        if known is None:
            part = _LAST if reference.until else _PARTS.get(min(reference.ended_by, key=str), '')
            text = str(reference) + part
            number = self._taken[text] = self._taken.get(text, 0) + 1
            known = text if number == 1 else f'{text}#{number}'
            self._resources[key] = known
        return known

    def _is_foreign(self, on: object) -> bool:
        """Whether a thread may set it; a callback that may, too, helps only if it comes."""
        if not isinstance(on, SettableRef):
            return False
        by = (each.by for each in self._world.wakings.get(on.number, ()) if each.word is Word.SET)
        return any(map(is_activity, by))

    def _with_wakers(self, raw: Blocking, named: Blocking, doer: Doer) -> Blocking:
        known = of_spin_aside(self._world, raw, named, doer)
        known = known or offered_late(self._world, raw, named, self._names)
        if known is not None:
            return known
        if isinstance(raw.on, MessageRef):
            return self._of_messages(raw.on, named)
        if isinstance(raw.on, TopicRef):
            senders = tuple(dict.fromkeys(self._senders(raw.on))) or (Waker(by=OUTSIDE),)
            return replace(named, wakers=senders)
        if isinstance(raw.on, DataRef):
            return self._of_data(raw, raw.on, named, doer)
        forked = self._world.forked
        if raw.call in OF_CHILDREN and forked is not None and raw.escapes is None:
            raw = replace(raw, escapes=Unknown(_OF_FORK, forked))
        unread = child_pipes.unread_at(self._world, raw, doer.effects or EffectLog())
        named = replace(named, unread=unread)
        row = WAITS.get(raw.call, NO_ROW)
        wakers = [Waker(by=by) for by in row.always]
        escapes = raw.escapes
        if isinstance(raw.resource, ResourceRef):
            more, why = self._wakers_of(raw, raw.resource, doer)
            wakers += more
            escapes = escapes or why
            wakings = wakings_of(self._world, raw.resource)
            given = [w for w in wakings if w.word in raw.resource.ended_by]
            named = self._with_ends(named, raw, raw.resource, given, doer)
            named, wakers = self._as_data_stays(named, wakers, raw.resource, given, doer)
            initial = self._initial(raw.resource, wakings)
            if given and may_find_it_done(raw, wakings, doer):
                initial = None
            number = initial_permits.counted(raw, initial, self._doers, given)
            is_sure = initial != 0 and escapes is None
            taken = taken_by_itself(raw, self._world, self._doers) if is_sure else None
            if taken is not None:
                wakers = [Waker(by=TIME, source=taken)]
            elif number:
                named = replace(named, initial=number)
            elif initial != 0:
                # A model of so many runs cannot say when they are used up.
                many = 'some' if initial is None else f'the first {initial}'
                escapes = escapes or Unknown(f'{many} {BY_ITSELF}', raw.source)
                named = replace(named, initial=initial_permits.few(initial))
        elif row.ended_by and isinstance(raw.on, EntityRef):
            is_here = isinstance(named.on, str) and named.on in self._names.values()
            wakers.append(Waker(by=str(named.on) if is_here else OUTSIDE))
        elif row.ended_by and escapes is None:
            unknown = Unknown('what is waited for is not known', raw.source)
            escapes = raw.on if isinstance(raw.on, Unknown) else unknown
        if isinstance(doer, EntityState) and way_of(raw) in doer.surely_waits:
            # The others of its branches are those of later runs, which never begin.
            behind = self._kept[id(doer)].places.get(way_of(raw), 0)
            wakers = [replace(waker, after=max(waker.after or 0, behind)) for waker in wakers]
            named = replace(named, conditional=False)
        if escapes is None and not ends_by_itself(wakers) and not named.initial:
            named = replace(named, unsent=self._unsent(raw, doer))
        return replace(named, wakers=tuple(dict.fromkeys(wakers)), escapes=escapes)

    def _of_data(self, raw: Blocking, on: DataRef, named: Blocking, doer: Doer) -> Blocking:
        """A loop that waits until other code has written what it reads."""
        writers = tuple(dict.fromkeys((*self._writers(on), *self._by_main(raw, on, doer))))
        signals = self._signals(on, doer)
        if signals is None:
            writers = as_unsure(writers)
        elif signals <= 0:
            writers = (Waker(by=TIME, source=raw.source),)
        by = [writer for writer, _ in self._writes(on)]
        why = data_is_written_elsewhere(self._world, on.names)
        why = why or (None if by else is_handed_over(self._world, on.holders))
        why = why or (None if by or not on.is_open_at_first else Unknown(_THERE, raw.source))
        unsure = why_gone(self._world, by, self._of_main_after(raw, doer), self._name)
        unsure = unsure or why_unspun(self._world, by, doer, self._name)
        if unsure is not None:
            writers = as_unsure(writers)
        asked = answer_from_outside(on.sent, by, self._world)
        is_poll = raw.call == POLLING_LOOP and raw.seconds is None
        asked = asked if is_poll and not is_activity(doer) else None
        is_open = why is not None or unsure is not None or ends_by_itself(writers)
        sent = on.sent_by_now
        unsent = None if is_open else unsent_before_end(raw, sent, by, doer, self._world)
        return replace(
            named,
            wakers=writers,
            escapes=why or unsure,
            answer_to=asked,
            unsent=unsent,
            signals=min(max(signals or 1, 1), MOST),
        )

    def _unsent(self, raw: Blocking, doer: Doer) -> str | None:
        """The topics on which no known code publishes before the wait has ended."""
        reference = raw.resource
        if not isinstance(reference, ResourceRef) or is_in_turn(reference, doer):
            return None
        stays = reference.is_kept and reference.number not in self._world.cleared
        if stays and not is_first(raw, reference, doer):
            return None
        by = [
            waking.by
            for waking in wakings_of(self._world, reference)
            if waking.word in reference.ended_by
            and not comes_last(waking, self._world)
            and (waking.by is doer or comes_unasked(waking, reference))
        ]
        sent = reference.sent
        if self._forgets(reference, doer):
            sent = sent_in_hold(reference, doer)
        return unsent_before_end(raw, sent, by, doer, self._world)

    def _wakers_of(
        self, raw: Blocking, reference: ResourceRef, doer: Doer
    ) -> tuple[list[Waker], Unknown | None]:
        wakings = wakings_of(self._world, reference)
        mine = [waking for waking in wakings if waking.word in reference.ended_by]
        uneven: Unknown | None = None
        if Word.ARRIVE in reference.ended_by:
            visits = barriers.visits_of(reference, self._doers)
            uneven = barriers.why_rounds_differ(raw, reference, visits, mine)
            mine = [waking for waking in mine if waking.by is not doer]
            if reference.parties == 1:
                return [Waker(by=TIME)], None
            if barriers.is_in_vain(reference, visits, mine):
                return [], self._why_open(mine, reference)
            mine = barriers.of_its_round(raw, doer, visits, mine)
        able = [waking for waking in mine if not never_comes(waking, doer)]
        found = [waker for waking in able for waker in self._wakers(waking, reference, doer, raw)]
        unsure = uneven or why_no_item(raw, reference, mine, self._world)
        unsure = unsure or why_uneven(able, self.rounds)
        unsure = unsure or self._why_unsure(raw, reference, mine, doer)
        unsure = unsure or why_in_another_run(raw, mine, doer)
        unsure = unsure or why_not_there(self._world, mine, doer, self._name)
        unsure = unsure or why_no_thread(mine, doer, self._name) or why_no_end(able, doer)
        if unsure is not None:
            found = list(as_unsure(found))
        found = by_interruption(raw, reference, mine, doer, self._world) or found
        why = self._why_open(mine, reference) or unsure or why_none(raw, mine, doer, self._world)
        return found, why

    def _with_ends(
        self,
        named: Blocking,
        raw: Blocking,
        reference: ResourceRef,
        given: list[Waking],
        doer: Doer,
    ) -> Blocking:
        return replace(
            named,
            forgets=forgets(reference, given, doer),
            answer_to=self._answer_to(raw, reference, doer),
            at_end=ended_last(given, doer, self._world, reference),
            cleared_late=sent_before_clear(reference, given, doer, self._doers),
        )

    def _answer_to(self, raw: Blocking, reference: ResourceRef, doer: Doer) -> str | None:
        """What the wait is an answer to; a thread that takes items in turn waits for no answer."""
        if raw.seconds is not None or is_in_turn(reference, doer):
            return None
        wakings = (w for w in wakings_of(self._world, reference) if w.word in reference.ended_by)
        by = [waking.by for waking in wakings if not comes_last(waking, self._world)]
        return answer_from_outside(reference.sent, by, self._world)

    def _forgets(self, reference: ResourceRef, doer: Doer) -> bool:
        wakings = wakings_of(self._world, reference)
        return forgets(reference, [w for w in wakings if w.word in reference.ended_by], doer)

    def _why_unsure(
        self, raw: Blocking, reference: ResourceRef, mine: list[Waking], doer: Doer
    ) -> Unknown | None:
        """Why those that end a wait may be gone by then, or come too early."""
        stays = reference.is_kept and reference.number not in self._world.cleared

        def comes_after(end: End) -> bool:  # of one's own waits the first has ended, and so all
            return stays and self._is_behind(end, raw, doer)

        wakers = [waking.by for waking in mine]
        # An error that ends a thread is what a join waits for.
        gone = [None if waking.word is Word.END else waking.by for waking in mine]
        why = why_gone(self._world, gone, comes_after, self._name)
        why = why or why_unspun(self._world, wakers, doer, self._name)
        if why is not None or forgets(reference, mine, doer):
            return why
        why = why_lost(self._world, reference, mine, doer, self._doers, self._name)
        if raw.seconds is not None or why is not None:
            return why
        return why_wiped_out(reference, mine, doer, self._doers) or why_early(reference, mine)

    def _is_behind(self, end: End, raw: Blocking, doer: Doer) -> bool:
        """Whether ``doer`` itself ends it, when it has waited."""
        places = self._kept[id(doer)].places
        return end.doer is doer and 0 < places.get(way_of(raw), 0) <= places.get(end.behind, 0)

    def _of_main_after(self, raw: Blocking, doer: Doer) -> Callable[[End], bool]:
        """What ``main``, which runs once, ends when it has waited is there while it waits."""
        is_main = isinstance(doer, ActivityState) and doer.kind is ActivityKind.MAIN
        return lambda end: is_main and self._is_behind(end, raw, doer)

    def _name(self, doer: object) -> str | None:
        return self._names.get(id(doer))

    def _why_open(self, mine: list[Waking], reference: ResourceRef) -> Unknown | None:
        """Why it is not known what ends the wait."""
        if reference.asked and reference.number not in self._world.given:
            return Unknown('somebody else may have taken what was asked for')
        return self._why_others(mine, reference)

    def _why_others(self, mine: list[Waking], reference: ResourceRef) -> Unknown | None:
        """Why unknown code may end the wait."""
        known = self._world.given.get(reference.number) or why_open(mine, reference, self._world)
        if known is not None:
            return known
        lost = next((w for w in mine if w.uncalled is not None), None)
        if lost is not None:
            return Unknown(f'no known code calls {lost.uncalled}, which ends it', lost.place)
        return uncalled_wakers(self._world, str(reference), reference.ended_by, reference.made)

    def _wakers(
        self, waking: Waking, reference: ResourceRef, doer: Doer, raw: Blocking
    ) -> Iterator[Waker]:
        by, place = waking.by, waking.place
        if by is None:
            if ends_for_good(waking, reference, self._world):
                yield Waker(by=TIME, source=place)
            return
        name = self._names.get(id(by))
        if name is None:
            yield Waker(by=OUTSIDE, source=place)
            return
        after = None if waking.word is Word.END else self.after(waking)
        stays = reference.is_kept and reference.number not in self._world.cleared
        yield Waker(
            by=name,
            source=place,
            after=after,
            conditional=self._may_fail(waking, reference, doer, raw, stays=stays),
            until=self._kept[id(by)].until(waking, after) if id(by) in self._kept else None,
            held=waking.held,
            passed=waking.taken,
        )

    def _may_fail(
        self, waking: Waking, reference: ResourceRef, doer: Doer, raw: Blocking, *, stays: bool
    ) -> bool:
        """Whether ``waking`` perhaps does not come, or not while ``doer`` waits."""
        is_done = stays and waking.unless_done
        if waking.conditional and not (
            is_done or is_never_left(waking, self._world, self._is_written)
        ):
            return True
        if self._forgets(reference, doer) and is_unheard(waking, doer):
            return True
        if reference.guard is not None and waking.by is doer and is_unheard(waking, doer):
            return True  # it notifies before it waits itself
        if may_not_come(waking, doer, self.rounds, stays=stays):
            return True
        return is_kept_out(waking, reference, doer, self._doers, raw)

    def _initial(self, reference: ResourceRef, mine: list[Waking]) -> int | None:
        """How many waits end without a waker, as the set-up leaves it."""
        if reference.initial is None or reference.is_kept:
            return reference.initial
        early = [waking for waking in mine if is_of_set_up(waking, self._world)]
        counted = [w for w in early if w.word in (Word.PUT, Word.RELEASE) and w.is_counted]
        return reference.initial + len(counted)

    def after(self, waking: Waking) -> int:
        """How many of its own waits the doer of ``waking`` has behind it then."""
        kept = self._kept.get(id(waking.by))
        return kept.places.get(waking.behind, 0) if kept is not None else 0
