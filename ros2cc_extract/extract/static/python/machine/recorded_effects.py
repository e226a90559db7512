"""What is followed by itself, and what it was seen to do meanwhile."""

from __future__ import annotations

from dataclasses import field
from itertools import takewhile
from typing import Any

from ros2cc_extract.extract.static.python.values.values import Function, Instance, Path
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Access, Act, Blocking

Hold = tuple[str, int]
"""A lock, and which time it is that it was taken."""


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


@dataclass(frozen=True)
class Stored:
    """
    An attribute gets a value, see ``torn_state.py``.

    :param item: of the container in it, where that is what gets the value.
    :param behind: the last wait that lay behind it.
    :param taken_from: arguments of the function that the value was taken from.
    :param named: what the source names in the value.
    :param exits: of a loop, or its first test, the branches inside that may leave it.
    :param begun: how many functions of the program had begun by then.
    """

    name: str
    item: str | None
    path: Path
    behind: object
    taken_from: frozenset[str]
    named: frozenset[str]
    begun: int


@dataclass
class Looked:
    """
    What a test of a loop looks at.

    :param holders: objects of the program, and the attributes that were read.
    :param outside: what belongs to code that is not followed, and may change by itself.
    """

    holders: list[tuple[Instance, str]] = field(default_factory=list)
    outside: list[Unknown] = field(default_factory=list)


@dataclass
class EffectLog:
    """
    What one callback or activity does, in the order of its text.

    :param behind: the last wait that lies behind what is followed now, as ``way_of`` returns it.
    :param own: names of what only the loop around it asks for: changes of objects that nobody
        else has, and of what lies in a collection.
    :param stored: names of what is written in a hold of a lock, see ``lost_notifications.py``.
    :param unread: of waits for a child process, where it is made and which pipe of it is not read
        before, see ``child_pipes.py``.
    :param met: waits as they are met, by their number, and how often the round waits there.
    :param loops: how many loops of several rounds, known ones, are followed now.
    :param order: messages, clears of events and waits for events, see ``cleared_events.py``.
    :param woken: of what others may wait on, by its identity, how many waits came before its wait
        was ended first.
    :param pieces: what is changed piece by piece, or published as a whole.
    :param looped: the waits in a loop with an unknown number of rounds, and what is written there.
    :param written: of a write, by name and place, what lay behind it, and whether on a branch.
    :param begun: how many functions of the program have begun.
    :param stored_last: what was stored last in an object, by its name and the way there.
    :param stored_anyway: the way to a store that rests on nothing read, see ``refreshed.py``.
    :param resting: loops that await something in each round.
    :param steps: what lets a number grow, by its place, see ``counted_tests.py``.
    :param taken: the locks that were taken by now on every branch, with the way to the first place
        at which each was.
    :param stored_or_stale: what was noted of data that the run has stored, see ``path_facts.py``.
    :param storers: the functions that were running when data was stored, by its name.
    :param ways: the branches that lead to a wait, by ``way_of``.
    :param looked: while a test is asked for what it looks at, see ``loop_ends.py``.
    """

    blocking: list[Blocking] = field(default_factory=list)
    reads: list[Access] = field(default_factory=list)
    writes: list[Access] = field(default_factory=list)
    locks: list[Act] = field(default_factory=list)
    publishes: list[Act] = field(default_factory=list)
    changes: list[Act] = field(default_factory=list)
    rounds: dict[int, set[tuple[int, ...]]] = field(default_factory=dict)
    met: list[tuple[int, int]] = field(default_factory=list)
    loops: int = 0
    own: list[str] = field(default_factory=list)
    behind: object = None
    stored: dict[Hold, set[str]] = field(default_factory=dict)
    looped: set[object] = field(default_factory=set)
    written: dict[object, tuple[object, bool]] = field(default_factory=dict)
    stored_last: dict[object, Stored] = field(default_factory=dict)
    stored_anyway: dict[tuple[str, Place], Path] = field(default_factory=dict)
    exits: dict[Place | None, frozenset[Place]] = field(default_factory=dict)
    begun: int = 0
    resting: set[Place | None] = field(default_factory=set)
    steps: dict[Place | None, Any] = field(default_factory=dict)
    unread: dict[object, tuple[Place, str]] = field(default_factory=dict)
    order: list[tuple[str, object]] = field(default_factory=list)
    pieces: list[Piece] = field(default_factory=list)
    woken: dict[int, int] = field(default_factory=dict)
    taken: dict[str, tuple[Place, ...]] = field(default_factory=dict)
    stored_or_stale: list[Any] = field(default_factory=list)
    storers: dict[str, set[tuple[Function, ...]]] = field(default_factory=dict)
    looked: Looked | None = None
    ways: dict[object, Path] = field(default_factory=dict)

    def note_way(self, block: Blocking, path: Path) -> None:
        """Note the branches that lead to a wait, as far as they are on all ways to it."""
        known = self.ways.setdefault(way_of(block), path)
        if known != path:
            shared = takewhile(lambda pair: pair[0] == pair[1], zip(known, path, strict=False))
            self.ways[way_of(block)] = tuple(step for step, _ in shared)


def way_of(block: Blocking) -> object:
    """Equal for one wait, however often it is met; one for another object is another wait."""
    number = getattr(block.resource, 'number', None)
    return block.call, block.source, block.chain, number


class Doer:
    """
    Code that is followed by itself, as it runs beside others: a callback, a thread.

    Subclasses say what the interpreter and the notes of waits ask of it.
    """

    effects: EffectLog | None
    place: Place

    @property
    def owner(self) -> Instance | None:
        """The library object that it belongs to."""
        return None

    @property
    def topic(self) -> str:
        """The topic whose messages it takes."""
        return ''

    @property
    def kind_name(self) -> str:
        """What a specification calls its kind."""
        return ''

    @property
    def has_own_text(self) -> bool:
        """Whether what was made for one value is kept apart from what was made for another."""
        return False

    @property
    def is_answered(self) -> bool:
        """Whether it takes answers that other code must give."""
        return False

    is_set_up: bool = False
    """Whether it is what the set-up does beside the callbacks."""

    @property
    def is_on_loop(self) -> bool:
        """Whether a loop of asyncio runs it, and no thread is held by what it awaits."""
        return False
