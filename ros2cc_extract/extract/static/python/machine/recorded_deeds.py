"""What callbacks and activities were seen to do, while they are followed."""

from __future__ import annotations

from dataclasses import dataclass, field

from ros2cc_extract.extract.static.python.machine.wake_operations import Hold, Waking, Word
from ros2cc_extract.extract.static.python.values.values import Call, Instance, Path, Value
from ros2cc_extract.places import Place, Unknown
from ros2cc_extract.spec.deeds import Access, Act, Blocking
from ros2cc_extract.spec.model import ActivityKind


@dataclass(frozen=True)
class Piece:
    """
    A part of an object is changed, or the whole of it is published, see ``torn_updates.py``.

    :param part: what is changed, as the source has it; empty for the whole.
    :param again: a loop changes one item of it after the other.
    """

    access: Access
    part: str
    path: Path
    again: bool


@dataclass
class Deeds:
    """
    What one callback or activity does, in the order of its text.

    :param behind: the last wait that lies behind what is followed now, as ``way_of`` tells it.
    :param own: names of what only the loop around it asks for: changes of objects that nobody
        else has, and of what lies in a collection.
    :param stored: names of what is written in a hold of a lock, see ``lost_notifies.py``.
    :param unread: of waits for a child process, where it is made and which pipe of it is not read
        before, see ``child_pipes.py``.
    :param loops: how many loops of several rounds, known ones, are followed now.
    :param order: messages, clears of events and waits for events, see ``cleared_events.py``.
    :param pieces: what is changed piece by piece, or published as a whole.
    :param looped: the waits that stand in a loop of which nobody knows how often it goes round.
    :param written: of a write, by name and place, what lay behind it, and whether on a branch.
    """

    blocking: list[Blocking] = field(default_factory=list)
    reads: list[Access] = field(default_factory=list)
    writes: list[Access] = field(default_factory=list)
    locks: list[Act] = field(default_factory=list)
    publishes: list[Act] = field(default_factory=list)
    changes: list[Act] = field(default_factory=list)
    rounds: dict[int, set[tuple[int, ...]]] = field(default_factory=dict)
    loops: int = 0
    own: list[str] = field(default_factory=list)
    behind: object = None
    stored: dict[Hold, set[str]] = field(default_factory=dict)
    looped: set[object] = field(default_factory=set)
    written: dict[object, tuple[object, bool]] = field(default_factory=dict)
    unread: dict[object, tuple[Place, str]] = field(default_factory=dict)
    order: list[tuple[str, object]] = field(default_factory=list)
    pieces: list[Piece] = field(default_factory=list)


def way_of(block: Blocking) -> object:
    """Equal for one wait, however often it is met."""
    return block.call, block.source, block.chain


@dataclass(eq=False)
class ActivityState:
    """
    Code that runs on a thread which no executor has.

    :param place: where it is started.
    :param runners: the threads or futures that stand for it; who waits on one waits for its end.
    :param starts: who starts it.
    :param endless: its loop that nothing ends, the end of rclpy included.
    :param again: where it starts itself anew in each run, whatever branches are taken.
    :param is_daemon: the same; ``None`` where that is not known.
    :param spins: how many spins the set-up has called before its start.
    :param ends_first: the set-up waits for its end before it spins again.
    :param serves: it spins an executor; for ever where it ``is_executor``.
    :param nodes: identities of the nodes that it touches, ``things`` those of other objects.
    :param turns: equal for those that have one thread between them.
    :param pool: whose threads run it.
    :param site: equal for one start that is met again.
    :param wakes: what it does to end waits, as it was seen in the set-up.
    :param thread: as ``World.thread`` counts them; ``on_loop`` where a loop of asyncio has it.
    """

    kind: ActivityKind
    place: Place
    target: Value | None = None
    call: Call | None = None
    runners: list[Value] = field(default_factory=list)
    starts: list[Waking] = field(default_factory=list)
    deeds: Deeds = field(default_factory=Deeds)
    path: Path = ()
    count: int | Unknown = 1
    daemon: bool = False
    is_daemon: bool | None = False
    loops: bool = False
    endless: Place | None = None
    again: Place | None = None
    spins: int = 0
    ends_first: bool = False
    serves: bool = False
    is_executor: bool = False
    nodes: set[int] = field(default_factory=set)
    things: set[int] = field(default_factory=set)
    site: object = None
    wakes: list[tuple[Value, Word, Place]] = field(default_factory=list)
    thread: int = 0
    on_loop: bool = False
    turns: object = None
    pool: Instance | None = None
