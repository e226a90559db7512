"""Who writes the data, or sends the messages, for which code waits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ros2cc_extract.extract.static.concurrency.activities import is_activity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    ClockRef,
    DataRef,
    TopicRef,
)
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.recorded_deeds import Deeds
from ros2cc_extract.places import Place
from ros2cc_extract.spec.deeds import OUTSIDE, Access, Blocking, Waker

Doer = EntityState | ActivityState


@dataclass
class Kept:
    """The waits of one callback or activity that the unit tells of, and where each raw one is."""

    raw: list[Blocking] = field(default_factory=list)
    named: list[Blocking] = field(default_factory=list)
    places: dict[object, int] = field(default_factory=dict)


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
        """Who writes what a loop waits for, but for what its own callback did before."""
        for doer in self._doers:
            for access in (doer.deeds or Deeds()).writes:
                is_before = (access.name, access.source) in on.before
                if access.name in on.names and not is_before:
                    yield doer, access

    def _movers(self, clock: object, topic: ClockRef) -> tuple[Waker, ...]:
        """Who moves a simulated clock: the subscription, and somebody who sends to it."""
        by = [clock if isinstance(clock, str) else OUTSIDE]
        if not any(self._senders(TopicRef(topic))):
            by.append(OUTSIDE)
        return tuple(Waker(by=each) for each in dict.fromkeys(by))

    def _writers(self, on: DataRef) -> Iterator[Waker]:
        for doer, access in self._writes(on):
            yield self._does(doer, access.name, access.source)

    def _senders(self, topic: TopicRef) -> Iterator[Waker]:
        """Who publishes what is waited for; the names are compared as they are written."""
        for doer in self._doers:
            for act in (doer.deeds or Deeds()).publishes:
                if isinstance(act.name, str) and act.name.strip('/') == topic.strip('/'):
                    yield self._does(doer, act.name, act.source)

    def _at_end(self, on: DataRef, doer: Doer) -> Iterator[Waker]:
        """What the program does when the spin has ended, which ends its threads from outside."""
        for name in sorted(on.names) if is_activity(doer) else ():
            by, place = self._world.other_writes.get(name, ('', None))
            if by is None:
                yield Waker(by=OUTSIDE, source=place)

    def _does(self, doer: Doer, name: str, source: Place | None) -> Waker:
        """A write or a message of ``doer`` that ends a wait."""
        behind, is_open = (doer.deeds or Deeds()).written.get((name, source), (None, False))
        after = self._kept[id(doer)].places.get(behind, 0)
        return Waker(by=self._names[id(doer)], source=source, after=after, conditional=is_open)
