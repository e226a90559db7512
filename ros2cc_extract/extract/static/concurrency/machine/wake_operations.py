"""What waits are for, and what is done to end them, until a unit has given names to all."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.counters import Rise
from ros2cc_extract.extract.static.concurrency.machine.loop_formulas import LoopTest
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import Hold
from ros2cc_extract.extract.static.python.values.values import (
    Const,
    Instance,
    Path,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place


class EntityRef(str):
    """
    Stands for an entity in a ``Blocking`` until the unit has given it a name.

    :param minds_nothing: a loop waits that does nothing which may raise when rclpy is shut down.
    """

    number: int
    minds_nothing = False

    @staticmethod
    def to_object(thing: object, text: str) -> EntityRef:
        """A reference to a node or executor; ``text`` stands for it outside every unit."""
        reference = EntityRef(text)
        reference.number = id(thing)
        return reference


class SettableRef(EntityRef):
    """Stands for an event, queue, thread … until it is known which one callback ends a wait."""

    @staticmethod
    def to_object(thing: object, text: str) -> SettableRef:
        """A reference to ``thing``; ``text`` stays where no one callback alone sets it."""
        reference = SettableRef(text)
        reference.number = id(thing)
        return reference


@dataclass(frozen=True)
class Guard:
    """
    What a wait for a condition rests on, see ``lost_notifications.py``.

    :param hold: of the lock of the condition; ``None`` where that was not followed.
    :param names: of the data that was asked for in that hold.
    :param is_open: something else was asked for too.
    :param begun: where something is made or started in that hold.
    :param until: data that it asks for again when it is notified, where it rests on nothing else;
        ``is_of_several`` where one change of it may not be enough.
    """

    hold: Hold | None
    names: frozenset[str]
    is_open: bool = False
    begun: frozenset[Place] = frozenset()
    until: frozenset[str] = frozenset()
    is_of_several: bool = False


class ResourceRef(SettableRef):
    """
    Stands for what is waited on until the unit has given it a name.

    :param ended_by: which operations on it end this wait.
    :param asked: it was asked before whether it would wait at all.
    :param like: identities of objects that were made at the same place.
    :param initial: how many waits end by themselves; ``None`` where that is not known.
    :param made: where it is made.
    :param is_kept: what ends the wait ends all that come after it.
    :param parties: of a barrier, how many must come; ``None`` where that is not known.
    :param is_own: a callback makes it anew in each run.
    :param guard: of a condition.
    :param answered: topics of messages whose answers may be gone, see ``cleared_events.py``.
    :param sent: topics of messages that come before the wait, and behind the one before.
    :param given: things given before it, or before the event is cleared, and the holds of locks.
    :param until: of a queue, the tests of the loop that ends by an item, see ``item_loops.py``.
    """

    until: tuple[LoopTest, ...] = ()
    ended_by: frozenset[Word] = frozenset()
    asked = False
    is_kept = False
    like: Sequence[int] = ()
    initial: int | None = 0
    made: Place | None = None
    parties: int | None = None
    is_own = False
    guard: Guard | None = None
    answered: frozenset[str] = frozenset()
    sent: frozenset[str] = frozenset()
    given: frozenset[tuple[int, frozenset[Hold]]] = frozenset()

    def with_end(self, until: tuple[LoopTest, ...]) -> ResourceRef:
        """The same queue, for a loop that takes from it until such an item comes."""
        reference = ResourceRef(self)
        reference.__dict__.update(self.__dict__)
        reference.until, reference.is_kept, reference.asked = until, True, False
        return reference


@dataclass(frozen=True, eq=False)
class Waking:
    """
    An operation that may end a wait of others.

    :param by: a callback or an activity; ``None`` for the set-up, and for what no known code
        calls.
    :param behind: the last wait of ``by`` before it, see ``EffectLog.behind``.
    :param path: the branches that it stands on; ``None`` where several ways lead there.
    :param spins: of the set-up, how many spins of its own thread are over, but for those of a loop
        in which it stands itself.
    :param uncalled: the function without a known caller in whose text it stands.
    :param is_counted: it happens once, on every branch.
    :param left: the branches before it that leave their loop or function, if no others lead there.
    :param in_loop: it stands in a loop with an unknown number of rounds.
    :param unless_done: branches skip it only where it has been done before.
    :param repeats: it stands in a loop.
    :param written: names of the data that ``by`` has written by then.
    :param holds: the locks that are held then.
    :param item: what is put.
    :param taken: the locks that it has surely taken by then.
    :param ended: of the set-up, the threads that it has surely waited for by then, by identity.
    """

    word: Word
    by: object
    place: Place
    behind: object = None
    conditional: bool = False
    path: Path | None = None
    after_spin: bool = False
    spins: int = 0
    uncalled: str | None = None
    held: tuple[str, ...] = ()
    is_counted: bool = False
    unless_done: bool = False
    left: frozenset[Place] = frozenset()
    in_loop: bool = False
    repeats: bool = False
    written: frozenset[str] = frozenset()
    holds: frozenset[Hold] = frozenset()
    item: Value | None = None
    taken: tuple[str, ...] = ()
    ended: frozenset[int] = frozenset()

    @property
    def is_sign(self) -> bool:
        """Whether what is put may be a sign to stop for the consumer: a constant, or an object."""
        options = options_of(self.item) if self.item is not None else ()
        return any(isinstance(option, (Const, Instance)) for option in options)


class DataRef(EntityRef):
    """
    Stands for plain data that a loop waits for other code to write.

    :param names: what the test reads; ``holders`` the objects and attributes where that is.
    :param before: what the loop's own callback has written before the loop, and where.
    :param sent: topics of messages that come before the loop; ``sent_by_now`` of all, with those
        of its rounds.
    :param tests: of the loop; ``is_open_at_first`` where it is not known that the loop waits for
        this data at all, beside other data.
    :param rise: of a number that has to grow, see ``counted_tests.py``.
    """

    number = 0
    rise: Rise | None = None
    tests: tuple[LoopTest, ...] = ()
    is_open_at_first = False
    sent: frozenset[str] = frozenset()
    sent_by_now: frozenset[str] = frozenset()
    names: frozenset[str] = frozenset()
    holders: frozenset[tuple[Instance, str]] = frozenset()
    before: frozenset[tuple[str, Place | None]] = frozenset()


class MessageRef(EntityRef):
    """
    Stands for what messages bring to the subscription of ``number``: simulated time, transforms.

    :param data: what ends the wait as well.
    """

    data: DataRef | None = None


class TopicRef(EntityRef):
    """Stands for the topic of an awaited message."""

    number = 0


@dataclass(frozen=True, eq=False)
class LoopRun:
    """A loop of asyncio is run by a thread, see ``World.thread``."""

    loop: Value
    thread: int


@dataclass(frozen=True, eq=False)
class LoopTouch:
    """
    Something of a loop of asyncio is touched, by a call that is for the thread of the loop.

    :param doer: a callback or an activity.
    """

    how: str
    thing: Value
    doer: object
    place: Place

    def is_same(self, other: LoopTouch) -> bool:
        """Whether it is the same call of the same object by the same doer."""
        is_call = self.place == other.place and self.doer is other.doer
        return is_call and self.thing is other.thing


@dataclass(frozen=True, eq=False)
class LoopAsk:
    """
    A callback calls what needs a loop of asyncio in its thread, and does not catch that none runs.

    :param how: the function of asyncio.
    :param is_any: a loop is enough that is not running, as the main thread has one.
    """

    how: str
    doer: object
    place: Place
    is_any: bool
