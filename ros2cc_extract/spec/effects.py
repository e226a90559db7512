"""
What code does while it runs: it waits, wakes others, takes locks, reads and writes.

The same values describe callbacks and activities; ``model.py`` says which.
"""

from __future__ import annotations

from enum import Enum

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown


class Needs(Enum):
    """How many of its wakers end a wait."""

    ONCE = 'once'
    EACH = 'each'
    ALL = 'all'


OUTSIDE = 'outside'
TIME = 'time'

BY_ITSELF = 'of these waits end by themselves'
"""Why a wait is left open if only so many end without a waker, as of a bounded queue."""

UNKNOWN_WAIT = 'unknown wait'
"""A call that waits by its name, on something that could not be followed."""

NOT_FOLLOWED = 'code that is not followed'
"""The rest of what is too long to be followed, or too late: there may be any wait in it."""

UNCALLED = 'no known code calls '
"""Why a wait is left open that stands in a function which follows by name."""

WORKING_LOOP = 'working loop'
"""A loop in which a thread works until it is ended: only its end is waited for."""

POLLING_LOOP = 'polling loop'
"""A loop that does nothing but wait until what it asks for has changed."""

ANSWER_LOOP = 'loop for an answer'
"""A loop that asks a library again and again; another program gives the answer that ends it."""

RECURSION_LIMIT = 1_000
"""Of CPython, where the program does not set another one."""

TURN = 'yield'
"""A coroutine lets the executor run others, and goes on by itself."""

AWAIT = 'await'
"""How a coroutine waits; with a blank and a name behind it, in an operation of asyncio."""

BUSY_LOOP = 'busy loop'
"""A loop that asks a clock again and again until some time is over, and does nothing else."""

PAUSES = frozenset(
    {'time.sleep', 'asyncio.sleep', 'Clock.sleep_for', 'Clock.sleep_until', BUSY_LOOP}
)
"""Calls that take a time which is given to them."""

ENDLESS_LOOP = 'endless loop'
"""A loop that no known code leaves."""


@dataclass(frozen=True, kw_only=True)
class Waker:
    """
    What can end a wait, and where.

    :param by: name of a callback or an activity of the unit, ``OUTSIDE`` (another process, the
        operating system) or ``TIME``.
    :param source: the operation that ends it: ``set``, ``notify``, ``put``, a write, an end.
    :param after: how many of its own waits (entries of ``blocking``) the waker has behind it
        then; ``None`` where its end, or what happens at its end, ends the wait.
    :param conditional: true where a branch may skip the operation.
    :param until: where it is conditional, how many of its own waits the waker has behind it where
        the branch ends that the operation stands on: those after it come only behind it.
    :param held: locks held at that operation, as of a ``Blocking``.
    :param passed: locks that it has surely had to take before.
    """

    by: str
    source: Place | None = None
    after: int | None = None
    conditional: bool = False
    until: int | None = None
    held: tuple[str, ...] = ()
    passed: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Blocking:
    """
    A call inside a callback that can hold its thread, or an ``await`` that holds its group.

    :param call: what blocks, in the field's words: ``client.call``, ``Event.wait``,
        ``time.sleep``, ``Rate.sleep``, ``spin_until_future_complete``, ``await`` …
    :param on: name of the callback, entity or object waited for, where known.
    :param seconds: how long it sleeps; for calls with a time-out, the time-out.
    :param foreign: true for an event or future that a thread of the user's own may set, which
        wakes no executor on some releases.
    :param chain: places of the calls that lead from the callback to ``source``, outermost first.
    :param held: locks held meanwhile, outermost first; one that its holder may take once more, as
        an ``RLock``, ends in ``RE_ENTRANT``.
    :param resource: name of the object waited on, equal for all waits on one object.
    :param wakers: what can end it, as far as is known.
    :param needs: ``ONCE``: one waker, for good (event, future, end of a thread); ``EACH``: one
        waker for each wait (condition, queue, semaphore); ``ALL``: every waker (barrier, several).
    :param signals: of ``ONCE``: how many of them, or how often one, as of a number that grows.
    :param forgets: of ``EACH``: what a waker does while nothing waits is lost (a condition that is
        waited on without asking first).
    :param initial: of ``EACH``, how many waits end without a waker: the value of a semaphore, the
        room in a queue. With ``escapes`` runs before may have used them up.
    :param counted: a model has runs enough to use up ``initial``; no specification says so.
    :param escapes: why unknown code might end it too, or what ends it is not known.
    :param conditional: true where a branch may skip the wait.
    :param only_if: what leads there, where a parameter decides and its default does not.
    :param assumed: the rule by which ``seconds`` was assumed.
    :param unread: ``stdout`` or ``stderr`` of a child process whose end is waited for while nobody
        reads that pipe.
    :param answer_to: the topic of the message on which another process must answer, by a
        subscription, before the wait ends.
    :param cleared_late: the topics of messages that are sent before an event is cleared, though
        only what they bring sets it again.
    :param unsent: the topics whose messages end it, if the publishing code of this program
        does not run before.
    :param at_end: of a thread, where the program ends the wait when its spin is over.
    :param repeats: a loop with an unknown number of rounds stands between one of the
        locks held and the wait.
    :param recursive: the loop is a function that calls itself: Python ends it by a RecursionError
        after ``RECURSION_LIMIT`` calls.
    :param times: how often a run waits here, as far as the rounds of loops around it are known.
    :param or_more: a loop around it has an unknown number of rounds as well; of other waits than
        pauses, only where ``times`` is more than one.
    :param caught: the exception by which some release says that the time-out is over is caught.
    """

    call: str
    source: Place | None = None
    on: str | Unknown | None = None
    seconds: float | Unknown | None = None
    foreign: bool = False
    chain: tuple[Place, ...] = ()
    held: tuple[str, ...] = ()
    resource: str | None = None
    wakers: tuple[Waker, ...] = ()
    needs: Needs = Needs.ONCE
    signals: int = 1
    forgets: bool = False
    initial: int = 0
    counted: bool = False
    escapes: Unknown | None = None
    conditional: bool = False
    only_if: str | None = None
    assumed: str | None = None
    unread: str | None = None
    answer_to: str | None = None
    cleared_late: str | None = None
    unsent: str | None = None
    at_end: Place | None = None
    repeats: bool = False
    recursive: bool = False
    times: int = 1
    or_more: bool = False
    caught: bool = False

    @property
    def suspends(self) -> bool:
        """An ``await``: the thread is free meanwhile, and the group stays closed."""
        return self.call == AWAIT or self.call.startswith(f'{AWAIT} ')

    @property
    def is_timed(self) -> bool:
        """Whether it ends after some time in any case."""
        return self.seconds is not None or any(waker.by == TIME for waker in self.wakers)

    @property
    def goes_by_data(self) -> bool:
        """
        Whether data decides both that a condition is waited on and that it is notified.

        So it is in a lock for readers and writers: one waits while others are at work, and these
        notify while one waits. Taken to happen at any time, both would show deadlocks that data
        prevents.
        """
        is_for_condition = self.call.startswith('Condition.') and self.conditional
        is_each = bool(self.wakers) and all(waker.conditional for waker in self.wakers)
        return is_for_condition and is_each


RE_ENTRANT = ' (re-entrant)'
SHARED = ' (shared)'
BEGINS = '…'
"""Behind the beginning of a key."""

FLAG = ' (flag)'
ADDS, TAKES, TAKES_ANY, EMPTIES = 'adds', 'takes', 'takes any', 'empties'
TAKES_NEXT, FILLS = 'takes next', 'fills'
COPIED, BY_INDEX, BY_KEY = 'a copy', 'by index', 'by key'
"""How a collection is gone over without asking it for the next item each time, or one is found."""
BY_NAME, BY_CALLBACK = ' may call it by a text', ' may call it by a text in a callback'
"""Why it is not known whether a function runs: in a thread, or where the executor has it."""
CANCELS = 'cancel'
"""The name of the change by which a timer ends itself after it has waited."""
ABORTS = 'abort'
"""The name of the change by which a callback stops a running goal."""
FOUND_NONE, FOUND_FALSE, FOUND_TRUE, FOUND_SOME = 'None', 'false', 'true', 'not None'
FOUND_THIS, FOUND_OTHER = '== ', '!= '


@dataclass(frozen=True, kw_only=True)
class Access:
    """
    A read or write of shared state by a callback.

    :param name: ``Class.attribute`` of an instance, or ``module.name`` of a global.
    :param locks: locks held at that place, outermost first; one that others may hold too, as
        readers do, ends in ``SHARED``. A flag that was found down and put up, by which others are
        to be kept out, ends in ``FLAG``.
    :param update: true when the old value is read for the new one (``+=``, ``append`` …).
    :param in_place: true for an update by one operation on the object itself (``append``,
        ``d[k] = v``), which CPython does in one piece.
    :param whole: true for a write of what is computed from the old value where CPython, by its
        global lock, lets no other thread in since that was read (``self.n += 1``).
    :param keeps_size: true for ``d[k] = v`` where the set-up has put in ``k``.
    :param moves: ``adds`` for one that puts in an item and takes none out, ``takes`` for one that
        takes a certain item out, ``takes any`` for one that takes out the next, and fails uncaught
        where there is none, ``empties`` for one that takes out all. Of a queue, ``takes next`` for
        one that fails or waits where there is none, ``fills`` where there is no room.
    :param iterates: class of the collection, where a loop goes over it; ``COPIED`` where all items
        are taken at once (``list(d)``), ``BY_INDEX`` where it counts through the indices.
    :param item: the one item that is meant, where its key or index is constant: ``'a'``, ``0``;
        or how its key begins, where that is a text: ``'a'…``.
    :param chosen: true for a change of the item that a look at the collection has led to, or
        of one whose new value was computed from what was read of the collection.
    :param rests: true for a write that rests on what was read of it before, by its value or by a
        test, and for the use of an object that was tested before.
    :param bare: true for the use of an object that each run comes to without any test before.
    :param clears: true where ``None`` is stored; ``lowers`` for another constant that is false.
    :param fills_none: true for a write by ``main``, where ``None`` was until then.
    :param found: of a write that rests on tests alone, what these have found: ``FOUND_NONE``, or
        ``FOUND_FALSE`` where anything false would do, ``FOUND_TRUE``, and ``FOUND_SOME`` for what
        is not ``None``; a constant behind ``FOUND_THIS``, or behind ``FOUND_OTHER`` where it is
        something else.
    :param constant: true for a write that rests on a test and stores a constant, as of a flag.
    :param literal: true for a write of a constant that stands there in the text, and that is not
        false: whoever comes there stores the same.
    :param at_once: true for a write of a flag right behind the test that has found it down:
        CPython, by its global lock, lets no other thread in between.
    :param compared: true for a read that only asks whether it is still what the code has in a
        name of its own.
    :param asked: true for a read by a test alone, of what the run may have stored before.
    :param fresh: true for a read to which no way leads on which the run has stored that data and
        has waited since, or by which a wait only asks anew whether it is over.
    :param looks_up: of a read that fails uncaught where an item is not there any more, which a
        look at the collection has found: ``BY_KEY``, as of a dictionary, or ``BY_INDEX``.
    :param admits: true for a read of a goal callback because of which it turns goals down.
    :param later: true for the use of an object where something was called since it was tested, and
        for the write of a value where something was called since that was read, or of another
        one where a function of the program has run since a test.
    :param joins: of a write, the attribute of the same object that was written before it, where
        others may run between the two.
    :param akin: both values were taken from one thing.
    :param turn: the way to where it comes in the order of the text, if not where it stands: what
        is stored comes behind a wait in its value, an argument before what its call waits for.
    """

    name: str
    source: Place | None = None
    locks: tuple[str, ...] = ()
    update: bool = False
    in_place: bool = False
    whole: bool = False
    keeps_size: bool = False
    moves: str | None = None
    iterates: str | None = None
    item: str | None = None
    chosen: bool = False
    rests: bool = False
    bare: bool = False
    clears: bool = False
    lowers: bool = False
    fills_none: bool = False
    found: str | None = None
    constant: bool = False
    literal: bool = False
    at_once: bool = False
    compared: bool = False
    asked: bool = False
    fresh: bool = False
    looks_up: str | None = None
    admits: bool = False
    later: bool = False
    joins: str | None = None
    akin: bool = False
    turn: tuple[Place, ...] = ()
    chain: tuple[Place, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Act:
    """
    Something else a callback does: takes a lock, publishes, creates an entity, moves a node.

    :param name: the lock, the topic, the entity or executor concerned.
    :param held: of a lock that is waited for, the locks held meanwhile, outermost first; its own
        name is among them where it cannot be taken twice; of what is made, the flags that the code
        has found down and put up.
    :param tries: of a lock that is taken only if it is free at once, or in some time.
    :param repeats: of what is made: it stands in a loop, so that one run may make several.
    :param after: of a message, how many of the waits come before it.
    :param conditional: of a message, true where a branch may skip it.
    """

    name: str | Unknown
    source: Place | None = None
    chain: tuple[Place, ...] = ()
    held: tuple[str, ...] = ()
    tries: bool = False
    repeats: bool = False
    after: int = 0
    conditional: bool = False
