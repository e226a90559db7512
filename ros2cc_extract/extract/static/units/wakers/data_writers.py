"""What writes the data, or sends the messages, for which code waits."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field, replace
from itertools import takewhile

from ros2cc_extract.extract.static.concurrency.activities import is_activity
from ros2cc_extract.extract.static.concurrency.machine.counters import MOST, Rise
from ros2cc_extract.extract.static.concurrency.machine.loop_formulas import UNKNOWN
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, is_in_process
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    DataRef,
    MessageRef,
    ResourceRef,
    TopicRef,
    Waking,
)
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import come_behind
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import Value
from ros2cc_extract.extract.static.units.wakers.endless_threads import may_be_over
from ros2cc_extract.extract.static.units.wakers.obstructed_wakers import is_off_its_loop
from ros2cc_extract.extract.static.units.wakers.operations import as_unsure
from ros2cc_extract.extract.static.units.wakers.uncertain_wakers import RECURRING
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import (
    BEGINS,
    OUTSIDE,
    WORKING_LOOP,
    Access,
    Act,
    Blocking,
    Needs,
    Waker,
)

Doer = EntityState | ActivityState


@dataclass
class Kept:
    """The waits of one callback or activity that are in the unit, and where each raw one is."""

    raw: list[Blocking] = field(default_factory=list)
    named: list[Blocking] = field(default_factory=list)
    places: dict[object, int] = field(default_factory=dict)

    def until(self, waking: Waking, after: int | None) -> int | None:
        """How many waits are behind the branch of ``waking``, see ``Waker.until``."""
        doer, path = waking.by, waking.path
        if after is None or path is None or not waking.conditional or not isinstance(doer, Doer):
            return None
        ways = doer.effects.ways if doer.effects is not None else {}
        elsewhere = {
            place for way, place in self.places.items() if ways.get(way, ())[: len(path)] != path
        }
        inside = takewhile(
            lambda place: place not in elsewhere, range(after + 1, len(self.raw) + 1)
        )
        return max(inside, default=None)


class DataWriters:
    """
    The callbacks and activities of a unit, with what they write and send.

    :param names: of entities, activities, nodes and the executor, by their identity.
    """

    def __init__(self, world: RosWorld, names: dict[int, str], doers: tuple[Doer, ...]) -> None:
        self._world = world
        self._names = names
        self._doers = doers
        self._kept: dict[int, Kept] = {}

    def _the_writer(self, on: DataRef) -> str:
        """The one callback that writes what a loop waits for, else the name of the data."""
        names = {
            name for doer, _ in self._writes(on) if (name := self._names.get(id(doer))) is not None
        }
        is_open = data_is_written_elsewhere(self._world, on.names) is not None
        is_one = len(names) == 1 and not is_open
        doer = next((doer for doer, _ in self._writes(on)), None)
        return names.pop() if is_one and not is_activity(doer) else str(on)

    def _writes(self, on: DataRef) -> Iterator[tuple[Doer, Access]]:
        """What writes the data a loop waits for, except what its own callback did before."""
        for doer in self._doers:
            is_apart = is_in_process(doer)
            effects = doer.effects or EffectLog()
            parts = (piece.access for piece in effects.pieces if piece.part)
            for access in (*effects.writes, *parts):
                is_meant = access.name in on.names and not _is_before(access, on)
                is_meant = is_meant and not (is_apart and _is_of_one_process(access, on))
                if is_meant and not self._leaves_as_is(access, on):
                    yield doer, access

    def _is_written(self, on: DataRef) -> bool:
        """Whether anything in the unit writes what a loop waits for."""
        return any(True for _ in self._writes(on))

    def _leaves_as_is(self, access: Access, on: DataRef) -> bool:
        """Whether a write stores what lets the loop go on, or another item than it asks for."""
        if _is_of_other_item(access, on):
            return True
        known = self._world.literals.get(access.source, UNKNOWN) if access.source else UNKNOWN
        if known is UNKNOWN or not on.tests:
            return False
        item = access.item if access.in_place else None
        return all(test.stays(access.name, item, known) for test in on.tests)

    def _as_data_stays(
        self,
        named: Blocking,
        wakers: list[Waker],
        reference: ResourceRef,
        given: Sequence[Waking],
        doer: Doer,
    ) -> tuple[Blocking, list[Waker]]:
        """A wait and its wakers: of what stays as it is, one waker ends all waits."""
        stays = self._stays_so(reference, given, doer)
        if stays is False:
            return named, wakers
        return replace(named, needs=Needs.ONCE), wakers if stays else list(as_unsure(wakers))

    def _stays_so(
        self, reference: ResourceRef, given: Sequence[Waking], doer: Doer
    ) -> bool | None:
        """
        Whether what a wait for a condition asks for stays as it is from the first time on.

        ``None`` where that is not sure: a method is asked, or a number grows. All that wait are
        notified then, or there is one: ``wait_for(lambda: self.ready)``.
        """
        guard = reference.guard
        names = (guard.until or guard.names) if guard is not None else frozenset()
        logs = [(each, each.effects or EffectLog()) for each in self._doers]
        writes = [(by, w) for by, log in logs for w in log.writes if w.name in names]
        waiting = [by for by, log in logs if any(_is_for(b, reference) for b in log.blocking)]
        is_for_all = len(waiting) < 2 or all(waking.item is None for waking in given)
        if guard is None or not writes or not is_for_all or any(by is doer for by, _ in writes):
            return False
        are_set = all(self._is_set(write) for _, write in writes)
        if are_set and guard.until and not guard.is_of_several:
            return True
        steps = [(by.effects or EffectLog()).steps.get(write.source) for by, write in writes]
        added = [step.by if step is not None else 0 for step in steps]
        return None if are_set or min(added) > 0 or max(added) < 0 else False

    def _is_set(self, write: Access) -> bool:
        """Whether it stores a value that does not say *no*, as a whole."""
        is_whole = not (write.update or write.in_place)
        is_no = write.source is not None and not self._world.literals.get(write.source, True)
        return is_whole and not is_no

    def _movers(self, taker: object, topic: MessageRef) -> tuple[Waker, ...]:
        """What brings it: the subscription, and a publisher that sends to it."""
        by = [taker if isinstance(taker, str) else OUTSIDE]
        if not any(self._senders(TopicRef(topic))):
            by.append(OUTSIDE)
        return tuple(Waker(by=each) for each in dict.fromkeys(by))

    def _of_messages(self, on: MessageRef, named: Blocking) -> Blocking:
        """A wait for what messages bring; what its data is by then may end it as well."""
        movers = self._movers(named.on, on)
        writers = () if on.data is None else tuple(dict.fromkeys(self._writers(on.data)))
        if on.data is None or not writers:
            return replace(named, wakers=movers, needs=Needs.ALL)
        why = data_is_written_elsewhere(self._world, on.data.names)
        return replace(named, wakers=(*writers, movers[0]), escapes=named.escapes or why)

    def _writers(self, on: DataRef) -> Iterator[Waker]:
        for doer, access in self._writes(on):
            yield self._does(doer, access.name, access.source)

    def _signals(self, on: DataRef, doer: Doer) -> int | None:
        """How many writes end the wait; ``None`` where one may not be enough."""
        writes = tuple(self._writes(on))
        if _is_of_whole(on) and _bring_parts(writes):
            return None
        if on.rise is None or len(on.names) != 1 or not writes:
            return 1
        steps = [(each.effects or EffectLog()).steps.get(access.source) for each, access in writes]
        known = [step for step in steps if step is not None]
        if len(known) < len(steps):
            return 1  # what is stored there may be as much as it takes
        mine = [
            access for access in (doer.effects or EffectLog()).writes if _is_before(access, on)
        ]
        left = on.rise.writes_left(self._stored_first(on.rise), known, len(mine))
        is_open = any(self._is_open(access, doer) for access in mine)
        is_open = is_open or any(step.repeats for step in known)
        # What the waiting run itself begins, as a task, comes as often as it has begun that.
        is_open = is_open or any(getattr(each, 'maker', None) is doer for each, _ in writes)
        is_open = is_open or (left is not None and left > MOST and not _all_recur(writes))
        return None if left is None or (left + len(mine) > 1 and is_open) else left

    def _stored_first(self, rise: Rise) -> Iterator[Value]:
        """What the set-up has stored there, or the class has."""
        doers = (doer.effects or EffectLog() for doer in self._doers)
        later = {access.source for effects in doers for access in effects.writes}
        stored = self._world.stored.get((rise.owner, rise.name), {})
        first = [value for place, value in stored.items() if place not in later]
        yield from first or rise.of_class

    def _is_open(self, access: Access, doer: Doer) -> bool:
        written = (doer.effects or EffectLog()).written
        return written.get((access.name, access.source), (None, True))[1]

    def _senders(self, topic: TopicRef) -> Iterator[Waker]:
        """What publishes the awaited message; the names are compared as they are written."""
        for doer in self._doers:
            for act in (doer.effects or EffectLog()).publishes:
                if isinstance(act.name, str) and act.name.strip('/') == topic.strip('/'):
                    yield self._does(doer, act.name, act.source)

    def messages_of(self, doer: Doer) -> tuple[Act, ...]:
        """What it publishes, each message with the waits that come before it."""
        acts = (doer.effects or EffectLog()).publishes
        sent = [(act, self._does(doer, act.name, act.source)) for act in acts]
        return tuple(
            replace(act, after=by.after or 0, conditional=by.conditional) for act, by in sent
        )

    def _by_main(self, raw: Blocking, on: DataRef, doer: Doer) -> Iterator[Waker]:
        """
        What the program does when the spin has ended, which ends its threads from outside.

        So does what it does beside them before; a thread that works meanwhile does not wait.
        """
        runners = doer.runners if isinstance(doer, ActivityState) else ()
        for name in sorted(on.names) if is_activity(doer) else ():
            if come_behind(self._world.main_writes.get(name, ()), runners):
                continue
            by, place = self._world.other_writes.get(name, ('', None))
            beside = self._world.writes_beside.get(name)
            if by is None:
                yield Waker(by=OUTSIDE, source=place)
            elif beside is not None and raw.call != WORKING_LOOP:
                yield Waker(by=OUTSIDE, source=beside)

    def _does(self, doer: Doer, name: str | Unknown, source: Place | None) -> Waker:
        """A write or a message of ``doer`` that ends a wait."""
        behind, is_open = (doer.effects or EffectLog()).written.get((name, source), (None, False))
        after = self._kept[id(doer)].places.get(behind, 0)
        is_open = is_open or is_off_its_loop(doer, self._doers)
        is_open = is_open or may_be_over(doer, (name, source))
        return Waker(by=self._names[id(doer)], source=source, after=after, conditional=is_open)


def _is_for(block: Blocking, reference: ResourceRef) -> bool:
    return isinstance(block.resource, ResourceRef) and block.resource.number == reference.number


def _is_before(access: Access, on: DataRef) -> bool:
    """Whether it lies before the loop in the run that waits."""
    return (access.name, access.source) in on.before


def _is_of_other_item(access: Access, on: DataRef) -> bool:
    """Whether it stores an item of a container of which the loop asks for others."""
    asked = {each for test in on.tests for each in test.formula.asked_of(access.name)}
    is_known = access.in_place and access.item is not None and not access.item.endswith(BEGINS)
    return is_known and bool(asked) and None not in asked and access.item not in asked


def _all_recur(writes: Iterable[tuple[Doer, Access]]) -> bool:
    """Whether all the writers run again and again."""
    return all(isinstance(by, EntityState) and by.kind in RECURRING for by, _ in writes)


def _is_of_whole(on: DataRef) -> bool:
    """Whether a loop asks for all of a collection: ``len(self.d) < 2``, ``x in d.values()``."""
    nodes = [node for test in on.tests for node in test.formula.nodes()]
    compared = [part for node in nodes for part in ast.walk(node) if isinstance(part, ast.Compare)]
    return any(map(_asks_for_more, compared))


def _asks_for_more(node: ast.Compare) -> bool:
    """Whether one item may not be enough."""
    (operator, *_), (other, *_) = node.ops, node.comparators
    if isinstance(operator, (ast.In, ast.NotIn)):
        return True
    is_length = isinstance(node.left, ast.Call) and getattr(node.left.func, 'id', '') == 'len'
    least = other.value if isinstance(other, ast.Constant) else None
    is_first = isinstance(operator, (ast.Eq, ast.LtE, ast.Gt)) and least == 0
    return is_length and not is_first and not (isinstance(operator, ast.Lt) and least == 1)


def _bring_parts(writes: Sequence[tuple[Doer, Access]]) -> bool:
    """Whether several doers each put in what is theirs."""
    by = {id(doer) for doer, access in writes if access.in_place}
    return len(by) > 1 and all(access.in_place for _, access in writes)


def _is_of_one_process(access: Access, on: DataRef) -> bool:
    """Whether a process writes what no other one sees; others may share what is not known."""
    name = access.name.rpartition('.')[2]
    held = [owner.slots.get(attribute) for owner, attribute in on.holders if attribute == name]
    is_known = bool(held) and all(isinstance(value, Collection) for value in held)
    return is_known or not access.in_place
