"""
What runs concurrently, and what a run leaves behind of it: threads, locks, waits, accesses.

The model of a library says what runs as a callback; here each is a ``Doer``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import field
from typing import Any

from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    LoopAsk,
    LoopRun,
    LoopTouch,
    Waking,
)
from ros2cc_extract.extract.static.python.machine.library_state import BESIDE, LibraryState
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer, EffectLog
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Heaped,
    Instance,
    Path,
    Scope,
    Value,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import ActivityKind, When

KeptIn = tuple[Instance, str]
"""The attribute of an object that keeps a thread."""
Holds = dict[str, int]
"""Locks that are held, with the number of each hold."""


@dataclass(eq=False)
class ActivityState(Doer):
    """
    Code that runs on a thread which no executor has.

    :param place: where it is started.
    :param runners: the threads or futures that stand for it; a wait on one is a wait for its end.
    :param starts: what starts it.
    :param endless: its loop that nothing ends, the end of rclpy included.
    :param until_shutdown: its loop that only the end of rclpy ends.
    :param overlaps: another one of it is started before the last one is known to be over.
    :param again: where it starts itself anew in each run, on every branch.
    :param is_daemon: the same; ``None`` where that is not known.
    :param spins: how many spins the set-up has called before its start.
    :param ends_first: the set-up waits for its end before it spins again.
    :param serves: it spins an executor; forever where it ``is_executor``.
    :param nodes: identities of the nodes that it touches, ``things`` those of other objects.
    :param turns: equal for those that have one thread between them.
    :param pool: the pool whose threads run it.
    :param site: equal for one start that is met again.
    :param wakes: what it does to end waits, as it was seen in the set-up, and what it puts.
    :param thread: as ``World.thread`` counts them; ``on_loop`` where a loop of asyncio has it,
        and ``loop`` is equal for what one loop has.
    :param alone: the attributes it is kept in, of which each start has found that the thread there
        has ended; with what starts it, and the holds of locks from that test on.
    :param left: attributes that it has itself emptied by now.
    :param interrupts: a handler of a signal, which runs between two lines of the main thread.
    """

    kind: ActivityKind
    place: Place
    target: Value | None = None
    call: Call | None = None
    runners: list[Value] = field(default_factory=list)
    starts: list[Waking] = field(default_factory=list)
    effects: EffectLog = field(default_factory=EffectLog)
    path: Path = ()
    count: int | Unknown = 1
    daemon: bool = False
    is_daemon: bool | None = False
    loops: bool = False
    endless: Place | None = None
    until_shutdown: Place | None = None
    overlaps: bool = False
    again: Place | None = None
    spins: int = 0
    ends_first: bool = False
    serves: bool = False
    is_executor: bool = False
    nodes: set[int] = field(default_factory=set)
    things: set[int] = field(default_factory=set)
    site: object = None
    wakes: list[tuple[Value, Word, Place, Value | None]] = field(default_factory=list)
    thread: int = 0
    on_loop: bool = False
    loop: object = None
    turns: object = None
    pool: Instance | None = None
    alone: dict[KeptIn, tuple[tuple[Doer | None, frozenset[tuple[str, int]]], ...]] | None = None
    left: set[KeptIn] = field(default_factory=set)
    interrupts: bool = False


def is_in_process(activity: object) -> bool:
    """Whether it is a process of its own, or started in one, and so has a memory of its own."""
    return process_of(activity) is not None


def process_of(activity: object) -> ActivityState | None:
    """The process that it is, or is started in; ``None`` for that of the program itself."""
    while isinstance(activity, ActivityState):
        if activity.kind is ActivityKind.PROCESS:
            return activity
        activity = activity.starts[0].by if activity.starts else None
    return None


@dataclass(eq=False)
class ThreadState(LibraryState):
    """A ``threading.Thread`` or timer: what it runs when started."""

    is_beside = True
    may_end_waits = True

    kind: ActivityKind
    target: Value | None = None
    call: Call | None = None
    started: bool = False


def thread_of(instance: Instance) -> ThreadState:
    """What an instance of a class of threads is as such."""
    state = instance.slots.get(BESIDE, instance.state)
    assert isinstance(state, ThreadState)
    return state


@dataclass(frozen=True, eq=False)
class Over:
    """
    The program has ended something that goes on beside it.

    :param what: an executor that is shut down, a thread that has been waited for; ``None`` where
        rclpy is shut down.
    :param spins: how many spins there were.
    """

    what: Instance | None
    path: Path
    spins: int


@dataclass(frozen=True, eq=False)
class TimedJoin:
    """The program has waited for a thread, but not forever; ``over`` is what had ended then."""

    thread: Instance
    path: Path
    over: tuple[Over, ...]


@dataclass(frozen=True, eq=False)
class OutsideWait:
    """
    Code that is no callback waits for the answer that ``client`` takes, or for a plain object.

    :param client: ``None`` where it looks at data again and again, of ``names``.
    :param spun: the nodes that it spins meanwhile.
    :param is_late: something has been spun before.
    :param over: what is over by then, ``path`` the undecided branches it stands in.
    :param begun: how many spins there were by then; ``None`` where their order is not known.
    :param is_called: the program itself does so, and not a function without a known caller.
    :param held: locks that are held meanwhile.
    """

    call: str
    client: Doer | Instance | None
    place: Place
    in_thread: bool
    spun: tuple[Instance, ...] = ()
    is_late: bool = False
    over: tuple[Over, ...] = ()
    path: Path = ()
    begun: int | None = None
    names: frozenset[str] = frozenset()
    is_called: bool = True
    held: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class SetUpWait:
    """
    A wait of code that no callback runs, as it is in ``outside`` too.

    :param block: with references to what it waits on.
    :param uncalled: the function without a known caller that leads there.
    :param by: the thread that waits; one that only spins has no waits of its own.
    :param is_late: the spin is over.
    :param in_handler: a handler of a signal waits, on the main thread.
    """

    block: Blocking
    outside: OutsideWait
    uncalled: str | None = None
    by: ActivityState | None = None
    is_late: bool = False
    in_handler: bool = False


@dataclass(frozen=True, eq=False)
class LockUse:
    """Which callbacks and threads take a lock, and which give it back, by their identity."""

    lock: Instance
    takers: set[int | None] = field(default_factory=set)
    givers: set[int | None] = field(default_factory=set)


@dataclass(frozen=True, eq=False)
class Cell:
    """A variable of a function that functions inside of it share, see ``closure_cells.py``."""

    scope: Scope
    name: str


@dataclass
class ConcurrentWorld(World):
    """
    One run, with what it does concurrently.

    :param activity: the thread or the part of the main program that is followed.
    :param spins_over: how many of the spins have ended for sure.
    :param thread: the thread that is followed, 0 for that of the set-up; ``threads`` counts them,
        and ``thread_depth`` is how many calls led to its start.
    :param wakings: what is done to an object that others may wait on, by its identity.
    :param asked: marks of questions that the function has asked.
    :param made_at: identities of the objects that others may wait on, by the place they come from.
    :param other_writes: data that is written by what no known code calls, with its name, or
        after the spin has ended, with ``None``.
    :param writes_beside: data that the set-up writes when it has started a thread, or has spun;
        ``main_writes`` that with the threads which it has surely waited for by each write.
    :param handed_on: functions that code which is not scanned has, as if each were a thread;
        ``answering`` those of them, by identity, by which a web server answers.
    :param servers: the threads that run web servers, and where.
    :param cleared: events that code clears: which and where, and how many entities there were.
    :param surely_cleared: the same of those that clear them on all their branches.
    :param by_loop: a loop of asyncio does what is followed, in its own thread.
    :param cancelled: where futures are cancelled, by where they are made.
    :param loop_runs: what runs one; ``loop_touches`` what is done to what belongs to one,
        ``loop_asks`` what needs one in its thread, and ``awaited_of_loops`` the queues and events
        that some coroutine awaits.
    :param loop_task: the task of such a loop that is followed, see ``loop_tasks.py``;
        ``loop_roots`` all that no other one has made, and ``loop_steps`` numbers what they do.
    :param sets_loops: some code gives its thread a loop.
    :param lost_wakes: what ends waits for an attribute of that name of what is not known.
    :param given: objects that were handed to code which is not followed, with the reason.
    :param kept_in: the attribute that an object others may wait on was stored in last, and
        ``met_meanwhile`` what such attributes held while the set-up waited for it.
    :param served: where a daemon thread waits for what nobody else has, by its identity.
    :param caught_raises: lines and columns, by file, of ``raise`` that some caller catches.
    :param left_callbacks: of futures that were not complete, see ``done_callbacks.py``; and
        ``completed`` the identities of those futures that code completes.
    :param activities: all of them, in the order of their start.
    :param followed_count: how many of them were followed for what they do.
    :param loop: where the loop of asyncio begins that runs the set-up.
    :param limit: how long each wait of a coroutine may last where ``asyncio.timeout`` is entered.
    :param forked: where the program splits off a child that runs its own text.
    :param on_loop: a callback runs a coroutine by asyncio, which holds its thread.
    :param second_pass: one is followed for what it does; what it makes is known already.
    :param readers: what reads the pipes of a child process, by the place where that is made.
    :param queues: what is put into queues, see ``queue_items.py``.
    :param homes: the attribute that first held a collection, see ``collection_aliases.py``.
    :param lent: the same of attributes that a method stores another one in, with their names.
    :param objects: the attribute that holds an object of unknown kind for good, by the object.
    :param members: what a field of such an object is called, by what is in it.
    :param locks: the locks that were taken, by the name they are stored under.
    :param main_spins: how many spins the set-up has called in its own thread, behind which no
        callback runs, and how many it had ``before_loop``, the outermost of those loops.
    :param main_takes: locks that the main program takes itself, with the number of handlers of
        signals by then.
    :param lock_uses: who takes and gives back each lock; ``signals`` where those locks are made
        of which an earlier run has found that they are signals, see ``signal_locks.py``.
    :param cells: variables that inner functions share, by the name they are shown by, and
        ``cell_scopes`` the calls of a function by the set-up that have such variables.
    :param loops_at: of a lock, how many of ``open_loops`` there were when it was taken.
    :param takes: how often each of them was taken; ``holds`` the number of the present hold,
        and ``begun`` where something was made or started in one.
    :param accepted: what the last function held wherever it did not turn down a goal.
    :param flag_tests: of a state that stands for a flag, what has been found of it by those who
        then put it up, see ``flag_locks.py``.
    :param ended: attributes whose thread has ended, by the step of the path, and the holds then.
    :param claims: the threads that were stored in such an attribute since, with those holds.
    :param unguarded: attributes where a thread is stored, or forgotten, without such a test.
    :param found_down: flags that the last function found down wherever it turned no goal down.
    :param still_down: those that were down when the goal was accepted which is executed.
    :param outside: what code waits for that is no callback.
    :param set_up: its waits as they are in the specification, each once.
    :param asked_until: calls in the tests of loops that only their answer ends.
    :param retried: calls that a loop tries again and again until they raise no error.
    :param asked_outside: calls by which a library asks others outside whether something is over.
    :param asked_messages: the subscriptions that bring what was asked for: the time of simulated
        clocks, transforms.
    :param over: what it has ended.
    :param joined_by_exit: identities of the threads that the interpreter has waited for, where
        what is registered for its end is followed.
    """

    activity: ActivityState | None = None
    in_thread: bool = False
    wakings: dict[int, list[Waking]] = field(default_factory=dict)
    asked: set[int] = field(default_factory=set)
    main_spins: int = 0
    lock_uses: dict[int, LockUse] = field(default_factory=dict)
    cells: dict[str, Cell] = field(default_factory=dict)
    cell_scopes: dict[int, list[Scope]] = field(default_factory=dict)
    signals: frozenset[Place] = frozenset()
    before_loop: int = 0
    made_at: dict[object, list[int]] = field(default_factory=dict)
    other_writes: dict[str, tuple[str | None, Place]] = field(default_factory=dict)
    writes_beside: dict[str, Place] = field(default_factory=dict)
    main_writes: dict[str, list[frozenset[int]]] = field(default_factory=dict)
    cleared: dict[int, dict[tuple[object, Place], int]] = field(default_factory=dict)
    surely_cleared: dict[int, set[tuple[object, Place]]] = field(default_factory=dict)
    by_loop: bool = False
    loop_runs: list[LoopRun] = field(default_factory=list)
    loop_touches: list[LoopTouch] = field(default_factory=list)
    loop_asks: list[LoopAsk] = field(default_factory=list)
    loop_task: Any = None
    loop_roots: dict[object, Any] = field(default_factory=dict)
    loop_steps: int = 0
    sets_loops: bool = False
    cancelled: dict[Place, Place] = field(default_factory=dict)
    awaited_of_loops: list[Value] = field(default_factory=list)
    lost_wakes: dict[tuple[str, Word], list[Place]] = field(default_factory=dict)
    given: dict[int, Unknown] = field(default_factory=dict)
    activities: list[ActivityState] = field(default_factory=list)
    followed_count: int = 0
    second_pass: bool = False
    accepted: tuple[str, ...] = ()
    flag_tests: dict[str, set[str]] = field(default_factory=dict)
    ended: dict[tuple[Place, int], dict[KeptIn, Holds]] = field(default_factory=dict)
    claims: dict[KeptIn, tuple[Value, Holds]] = field(default_factory=dict)
    unguarded: set[KeptIn] = field(default_factory=set)
    found_down: frozenset[str] = frozenset()
    still_down: frozenset[str] = frozenset()
    readers: dict[Place, list[EffectLog | None]] = field(default_factory=dict)
    queues: dict[int, Any] = field(default_factory=dict)
    homes: dict[Value, tuple[Value, str]] = field(default_factory=dict)
    lent: dict[Value, tuple[Value, str, str]] = field(default_factory=dict)
    objects: dict[Value, str] = field(default_factory=dict)
    members: dict[Value, str] = field(default_factory=dict)
    locks: dict[str, list[Instance]] = field(default_factory=dict)
    takes: Counter[str] = field(default_factory=Counter)
    loops_at: dict[str, int] = field(default_factory=dict)
    holds: dict[str, int] = field(default_factory=dict)
    begun: dict[tuple[str, int], set[Place]] = field(default_factory=dict)
    outside: list[OutsideWait] = field(default_factory=list)
    set_up: dict[object, SetUpWait] = field(default_factory=dict)
    asked_until: set[Place] = field(default_factory=set)
    retried: set[Place] = field(default_factory=set)
    asked_outside: set[Place] = field(default_factory=set)
    asked_messages: list[Doer] = field(default_factory=list)
    over: list[Over] = field(default_factory=list)
    timed_joins: list[TimedJoin] = field(default_factory=list)
    joined_by_exit: frozenset[int] = frozenset()
    after_spin: bool = False
    on_loop: bool = False
    forked: Place | None = None
    loop: Place | None = None
    limit: Value | None = None
    spins_over: int = 0
    thread: int = 0
    threads: int = 0
    thread_depth: int = 0
    exit_hooks: list[tuple[Value, Call]] = field(default_factory=list)
    signal_handlers: list[ActivityState] = field(default_factory=list)
    handed_on: list[tuple[ActivityState, str]] = field(default_factory=list)
    servers: list[tuple[int, Place]] = field(default_factory=list)
    answering: set[int] = field(default_factory=set)
    main_takes: list[tuple[str, Place, int]] = field(default_factory=list)
    interruptible: set[int] = field(default_factory=set)
    served: dict[int, Place] = field(default_factory=dict)
    kept_in: dict[Value, tuple[Heaped, str]] = field(default_factory=dict)
    caught_raises: dict[str, set[tuple[int, int]]] = field(default_factory=dict)
    met_meanwhile: dict[tuple[Heaped, str], dict[object, Instance]] = field(default_factory=dict)
    left_callbacks: list[Any] = field(default_factory=list)
    completed: set[int] = field(default_factory=set)

    @property
    def own_loop(self) -> Place | None:
        """Where the loop of asyncio begins that runs what is followed."""
        return self.loop

    @property
    def is_on_loop(self) -> bool:
        """Whether a loop of asyncio runs the callback that is followed."""
        return self.in_callback and self.current is not None and self.current.is_on_loop

    @property
    def is_set_up_on_loop(self) -> bool:
        """Whether that is the main program, which goes on beside the callbacks."""
        return self.is_on_loop and self.current is not None and self.current.is_set_up

    @property
    def is_beside_others(self) -> bool:
        """Whether the set-up is followed, and something was spun or a thread was started."""
        return self.when is When.START and bool(self.threads or self.spins_begun)

    @property
    def spins_begun(self) -> int:
        """How often the program has let callbacks run, in any thread."""
        return 0

    @property
    def things_made(self) -> int:
        """How much there is that may run as a callback."""
        return 0

    @property
    def spun_in_loop(self) -> bool:
        """Whether what is followed stands in a loop that has spun, and may again."""
        return self.open_loops > 0 and self.main_spins > self.before_loop

    def done_alike(self, thing: int, made_there: Iterable[int]) -> list[Waking]:
        """What is done to objects of one place which may be the one that another run has made."""
        others = (number for number in made_there if number not in self.apart.get(thing, ()))
        return [waking for number in others for waking in self.wakings.get(number, ())]

    def begin_outermost_loop(self) -> None:
        """Keep how many spins there were: those of its rounds may come again."""
        self.before_loop = self.main_spins

    def served_within(self, file: str, first: int, last: int) -> tuple[Instance, ...]:
        """The nodes whose callbacks the lines of a file let run."""
        return ()
