"""
What one run of a program's set-up leaves behind: its nodes, entities, groups and spins.

Records are mutable while the run goes on and belong to this room; ``units.py`` turns them
into the frozen values of the specification.
"""

from __future__ import annotations

import ast
from collections import Counter
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, TypeVar

from ros2cc_extract.diagnostics import Diagnostic
from ros2cc_extract.extract.static.python.machine.dependences import Reading
from ros2cc_extract.extract.static.python.machine.recorded_deeds import ActivityState, Deeds
from ros2cc_extract.extract.static.python.machine.wake_operations import (
    LoopRun,
    LoopTouch,
    Waking,
    Word,
)
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Class,
    Function,
    Heaped,
    Instance,
    Mystery,
    Path,
    Value,
)
from ros2cc_extract.places import Place, Unknown
from ros2cc_extract.spec.deeds import Access, Act, Blocking
from ros2cc_extract.spec.model import ActivityKind, EntityKind, GroupType, When


@dataclass(eq=False)
class GroupState:
    """
    A callback group.

    :param node: the node whose default group it is.
    :param unresolved: why it could not be followed, or why its type is not certain.
    """

    type: GroupType = GroupType.EXCLUSIVE
    node: Instance | None = None
    default: bool = False
    groupless: bool = False
    unresolved: Unknown | None = None
    library: str | None = None
    custom: str | None = None
    count: int | Unknown = 1


@dataclass(eq=False)
class NodeState:
    """
    A ROS node.

    :param name: value of the name argument; ``None`` when none was seen.
    :param ghost: why it is not known which node it is; set for a node handed in from outside.
    :param parameter_callbacks: what runs when parameters are set, by stage, the latest first.
    :param more: why it may have entities that we do not see.
    :param begun: the call of ``Node.__init__``.
    :param nested: a spin inside a callback that serves it, and where.
    :param loop: the loop of asyncio whose thread spins it.
    :param sim_clock: the subscription that moves its clock, where it uses simulated time.
    """

    default_group: Instance
    name: Value | None = None
    ghost: Unknown | None = None
    lifecycle: bool = False
    on_asyncio: bool = False
    rate_group: Instance | None = None
    has_parameter_services: bool = True
    parameter_callbacks: dict[str, list[Value]] = field(default_factory=dict)
    more: list[tuple[str, Place | None]] = field(default_factory=list)
    spun: bool = False
    begun: Place | None = None
    nested: tuple[str, Place] | None = None
    sim_clock: EntityState | None = None
    loop: Place | None = None
    count: int | Unknown = 1


@dataclass(eq=False)
class ExecutorState:
    """
    An executor; its slot ``nodes`` holds the nodes it has, in order.

    :param threads: number of worker threads, ``None`` for the number of CPUs at run time.
    :param unresolved: why its kind or thread count could not be followed.
    """

    kind: str
    threads: int | None = 1
    threads_at: Place | None = None
    threads_unresolved: Unknown | None = None
    is_global: bool = False
    unknown: Unknown | None = None
    unresolved: Unknown | None = None
    assumed: str | None = None
    spun: bool = False


@dataclass(eq=False)
class EntityState:
    """
    A ROS entity or a piece of group-less work; one record for each that is made.

    :param assumed: the rule by which it is assumed to be there.
    :param held: flags that its maker has handed over to it, see ``flag_locks.py``.
    :param ran: how many of its functions were followed; -1 before any is.
    :param maker: the callback or activity that makes it, if any does.
    :param part_of: the subscription whose event it handles.
    :param dormant: where it is made so that it does not start by itself, or is cancelled at once.
    :param restarted: somebody starts it, or starts it again.
    """

    kind: EntityKind
    node: Instance
    group: Instance
    place: Place
    callback: Value | None = None
    key: Value | None = None
    period: Value | None = None
    path: Path = ()
    count: int | Unknown = 1
    when: When = When.START
    library: str | None = None
    builtin: bool = False
    destroyed: bool = False
    one_shot: bool = False
    dormant: Place | None = None
    restarted: bool = False
    label: str | None = None
    extra_callbacks: tuple[Value, ...] = ()
    ran: int = -1
    deeds: Deeds | None = None
    argument: Value | None = None
    goal_callback: Value | None = None
    defers: bool = False
    held: tuple[str, ...] | None = None
    number: int = 0
    maker: object = None
    part_of: EntityState | None = None
    assumed: str | None = None


class AccessKind(Enum):
    """How a callback touches shared state; an update needs the old value.

    One in place is a single operation on the object: ``append``, ``d[k] = v``, ``del d[k]``.
    """

    READ = 'read'
    WRITE = 'write'
    UPDATE = 'update'
    UPDATE_IN_PLACE = 'update in place'
    WITHIN = 'change of something in it'


@dataclass(eq=False)
class Spin:
    """
    One spin call: the executor, the nodes it has then, and how it is called.

    :param thread: which thread does it, 0 for the one of the set-up.
    :param from_callback: that thread is one that a callback starts.
    :param over: how many of the spins before it were over then.
    :param is_tried: what rises out of it may be caught.
    """

    executor: Instance
    nodes: tuple[Instance, ...]
    how: str
    place: Place
    path: Path
    for_ever: bool
    in_thread: bool
    repeated: bool = False
    timeout: Value | None = None
    thread: int = 0
    from_callback: bool = False
    over: int = 0
    is_tried: bool = False

    @property
    def key(self) -> object:
        """Equal for one call that is met again, as in a loop."""
        nodes = tuple(id(node) for node in self.nodes)
        return (id(self.executor), nodes, self.place, self.path, self.in_thread)


@dataclass(frozen=True, eq=False)
class InsideSpin:
    """
    A callback spins an executor.

    :param held: the locks that are held meanwhile.
    """

    entity: EntityState
    executor: Instance
    how: str
    timeout: Value | None
    place: Place
    held: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class End:
    """
    A callback, or a thread of the program's own, ends something that is served.

    :param what: the node, executor or entity.
    :param text: what is done, where that is no end but comes after one.
    :param behind: the last wait of ``doer`` before it, see ``Deeds.behind``.
    :param locks: held at that place.
    """

    kind: str
    what: Instance | EntityState | None
    doer: EntityState | ActivityState
    place: Place
    text: str = ''
    behind: object = None
    locks: tuple[str, ...] = ()


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
class OutsideWait:
    """
    Code that is no callback waits for the answer that ``client`` takes, or for a plain object.

    :param client: ``None`` where it looks at data again and again, of ``names``.
    :param spun: the nodes that it spins meanwhile.
    :param is_late: something has been spun before.
    :param over: what is over by then, ``path`` the undecided branches it stands in.
    :param begun: how many spins there were by then; ``None`` where their order is not known.
    """

    call: str
    client: EntityState | Instance | None
    place: Place
    in_thread: bool
    spun: tuple[Instance, ...] = ()
    is_late: bool = False
    over: tuple[Over, ...] = ()
    path: Path = ()
    begun: int | None = None
    names: frozenset[str] = frozenset()


@dataclass(frozen=True, eq=False)
class SetUpWait:
    """
    A wait of code that no callback runs, as ``outside`` tells it too.

    :param block: with references to what it waits on.
    :param uncalled: the function, which nobody in sight calls, that leads there.
    :param by: the thread that waits; one that only spins has no waits of its own.
    :param is_late: the spin is over.
    """

    block: Blocking
    outside: OutsideWait
    uncalled: str | None = None
    by: ActivityState | None = None
    is_late: bool = False


@dataclass(eq=False)
class ThreadState:
    """A ``threading.Thread`` or timer: what it runs when started."""

    kind: ActivityKind
    target: Value | None = None
    call: Call | None = None
    started: bool = False


AS_THREAD = '__as_thread__'
"""Slot of what an object is as a thread, which is something else besides."""


def thread_of(instance: Instance) -> ThreadState:
    """What an instance of a class of threads is as such."""
    state = instance.slots.get(AS_THREAD, instance.state)
    assert isinstance(state, ThreadState)
    return state


@dataclass(eq=False)
class PlainState:
    """A library object of which only the kind matters: a lock, an event, a publisher …"""

    kind: str
    key: Value | None = None
    of: Value | None = None
    place: Place | None = None


@dataclass(frozen=True)
class Cut:
    """
    Why something may be missing from the units.

    :param classes: those whose methods were running then.
    """

    reason: str
    place: Place
    classes: frozenset[Class] = frozenset()


# A loop that is unrolled meets the same deed again and again.
RECENT = 40

Deed = TypeVar('Deed', Access, Act, Cut)


def note_once(noted: list[Deed], deed: Deed) -> None:
    """Note ``deed`` unless it has just been noted."""
    # Ten times as fast as the comparison of dataclasses, which makes tuples first.
    fields = deed.__dict__
    if not any(fields == other.__dict__ for other in noted[-RECENT:]):
        noted.append(deed)


@dataclass
class World:
    """
    One run.

    :param path: the undecided branches we are in.
    :param count: how often what is made now is made (loops).
    :param spins_over: how many of the spins have ended for sure.
    :param thread: the thread that is followed, 0 for that of the set-up; ``threads`` counts them.
    :param is_program: it is run from an entry, so that nothing happens before its set-up.
    :param wakings: what is done to an object that others may wait on, by its identity.
    :param asked: marks of questions that the function has asked.
    :param open_loops: how many loops are followed of which nobody knows how often they go round.
    :param ready: what has surely happened to objects that others may wait for, see
        ``path_facts.py``.
    :param picked: what had happened to items for which they were put into a collection, by its
        serial number.
    :param skipped_if: of a branch, what has surely happened where it is not taken.
    :param made_at: identities of the objects that others may wait on, by the place they come from.
    :param other_writes: data that is written by what nobody in sight calls, with its name, or
        after the spin has ended, with ``None``.
    :param cleared: events that somebody clears: who and where, and how many entities there were.
    :param by_loop: a loop of asyncio does what is followed, in its own thread.
    :param loop_runs: who runs one; ``loop_touches`` what is done to what belongs to one, and
        ``awaited_of_loops`` the queues and events that some coroutine awaits.
    :param lost_wakes: what ends waits for an attribute of that name of what is not known.
    :param given: objects that were handed to code which is not followed, with the reason.
    :param kept_in: the attribute that an object others may wait on was stored in last, and
        ``met_meanwhile`` what such attributes held while the set-up waited for it.
    :param left_callbacks: of futures that were not complete, see ``done_callbacks.py``; and
        ``completed`` the identities of those futures that somebody completes.
    :param activity: the thread or the part of the main program that is followed.
    :param activities: all of them, in the order of their start.
    :param told: how many of them were followed for what they do.
    :param loop: where the loop of asyncio begins that runs the set-up.
    :param forked: where the program splits off a child that runs its own text.
    :param on_loop: a callback runs a coroutine by asyncio, which holds its thread.
    :param retelling: one is followed for what it does; what it makes is known already.
    :param called: every function that was followed, by the identity of its statement.
    :param subclasses: the direct ones of each class, in the order of their definition.
    :param made_of: how many instances there are of each class.
    :param followed_later: how many methods of each class were followed without a caller.
    :param settled: instances in which nothing was left to follow, with a stamp of that time.
    :param without_caller: the objects on which those were followed that nobody in sight calls.
    :param readers: who reads the pipes of a child process, by the place where that is made.
    :param queues: what is put into queues, see ``queue_items.py``.
    :param homes: the attribute that first held a collection, see ``collection_aliases.py``.
    :param objects: the attribute that holds an object of unknown kind for good, by the object.
    :param locks: the locks that were taken, by the name they are stored under.
    :param main_spins: how many spins the set-up has called in its own thread, behind which no
        callback runs, and how many it had ``before_loop``, the outermost of those loops.
    :param loops_at: of a lock, how many of ``open_loops`` there were when it was taken.
    :param takes: how often each of them was taken; ``holds`` the number of the present hold,
        and ``begun`` where something was made or started in one.
    :param yielding: the last generator that ran, with the locks that it keeps while it yields.
    :param accepted: what the last function held wherever it did not turn down a goal.
    :param admitted: flags that hold for an accepted goal, by node and place of the action server.
    :param flag_tests: of a state that stands for a flag, what has been found of it by those who
        then put it up, see ``flag_locks.py``.
    :param found_down: flags that the last function found down wherever it turned no goal down.
    :param open_to: those that were down when a goal was accepted, by the same.
    :param still_down: those that were down when the goal was accepted which is executed.
    :param outside: what code waits for that is no callback.
    :param message_waits: who waits for a message of which node, see ``taken_messages.py``.
    :param set_up: its waits as the specification tells them, each once.
    :param over: what it has ended.
    :param looking: the properties that are running, by owner and name.
    :param same_unknowns: arguments of callers not in sight that one attribute holds in turn.
    :param lists_builtin: whether ``builtins`` gets what rclpy makes by itself.
    :param reading: what the callback that is followed has read.
    :param times: how often a loop does what is followed once, where that is known.
    :param round: which rounds of the loops around it are followed, where that tells them apart.
    :param iterating: class of the collection that a loop begins to go over.
    :param parts: what was made while an object was set up, by the identity of the object.
    :param moves: what the call does to a collection that follows, see ``Access``.
    :param refilling: an item is stored under a key that the dictionary surely has.
    :param assumed: the rule by which the running loop is assumed to go over these items.
    :param stopped: this branch of the program has ended.
    :param trees: the text of every module that was run; ``files`` with the names of its file.
    :param changing: how often a callback has read what other functions may change.
    :param unset: how often one has read ``None`` where other functions put something.
    :param lacking: attributes that callbacks asked for before anybody had set them, and (without
        a name) collections before anybody had put an object in.
    :param missing: open tests on whether something is there yet.
    :param again: the running callback is followed once more; what it makes, it has made then.
    :param stored: what each attribute was ever assigned, by the place of that.
    :param trying: running calls and open branches directly in a ``try`` for a ``TypeError``.
    :param tries: how many ``try`` around may catch what is raised.
    :param met: the objects that the running callback found in what others assign.
    :param met_by: the same of each callback that was followed, by the identity of its entity.
    :param rounds: how often it was followed again for others.
    :param tested: the value of the last test.
    :param conditions: of a branch that no default leads to, what setting does.
    :param plain: whether a function works on plain data alone, by the identity of its statement.
    :param plain_of: how many modules that was asked of.
    :param spent: the steps that such calls have taken, by the same, and under 0 of all.
    :param doubted: classes and functions behind code that is not scanned, and what that is.
    :param doubted_calls: how often these were called.
    """

    path: Path = ()
    count: int | Unknown = 1
    when: When = When.START
    is_program: bool = False
    in_thread: bool = False
    stopped: bool = False
    assumed: str | None = None
    deeds: Deeds | None = None
    reading: Reading = field(default_factory=Reading)
    current: EntityState | None = None
    wakings: dict[int, list[Waking]] = field(default_factory=dict)
    asked: set[int] = field(default_factory=set)
    open_loops: int = 0
    main_spins: int = 0
    before_loop: int = 0
    picked: dict[int, frozenset[tuple[Value, Word]]] = field(default_factory=dict)
    skipped_if: dict[tuple[Place, int], frozenset[tuple[Value, Word]]] = field(
        default_factory=dict
    )
    ready: frozenset[tuple[Value, Word]] = frozenset()
    made_at: dict[object, list[int]] = field(default_factory=dict)
    other_writes: dict[str, tuple[str | None, Place]] = field(default_factory=dict)
    cleared: dict[int, dict[tuple[object, Place], int]] = field(default_factory=dict)
    by_loop: bool = False
    loop_runs: list[LoopRun] = field(default_factory=list)
    loop_touches: list[LoopTouch] = field(default_factory=list)
    awaited_of_loops: list[Value] = field(default_factory=list)
    lost_wakes: dict[tuple[str, Word], list[Place]] = field(default_factory=dict)
    given: dict[int, Unknown] = field(default_factory=dict)
    kept_inside: dict[int, Place] = field(default_factory=dict)
    activity: ActivityState | None = None
    activities: list[ActivityState] = field(default_factory=list)
    told: int = 0
    retelling: bool = False
    chain: tuple[Place, ...] = ()
    held: tuple[str, ...] = ()
    yielding: tuple[Value, tuple[str, ...]] | None = None
    accepted: tuple[str, ...] = ()
    admitted: dict[tuple[Instance, Place], tuple[str, ...]] = field(default_factory=dict)
    flag_tests: dict[str, set[str]] = field(default_factory=dict)
    found_down: frozenset[str] = frozenset()
    open_to: dict[tuple[Instance, Place], frozenset[str]] = field(default_factory=dict)
    still_down: frozenset[str] = frozenset()
    readers: dict[Place, list[Deeds | None]] = field(default_factory=dict)
    queues: dict[int, Any] = field(default_factory=dict)
    homes: dict[Value, tuple[Instance, str]] = field(default_factory=dict)
    objects: dict[Value, str] = field(default_factory=dict)
    locks: dict[str, list[Instance]] = field(default_factory=dict)
    takes: Counter[str] = field(default_factory=Counter)
    loops_at: dict[str, int] = field(default_factory=dict)
    holds: dict[str, int] = field(default_factory=dict)
    begun: dict[tuple[str, int], set[Place]] = field(default_factory=dict)
    outside: list[OutsideWait] = field(default_factory=list)
    set_up: dict[object, SetUpWait] = field(default_factory=dict)
    over: list[Over] = field(default_factory=list)
    after_spin: bool = False
    on_loop: bool = False
    forked: Place | None = None
    loop: Place | None = None
    nodes: list[Instance] = field(default_factory=list)
    entities: list[EntityState] = field(default_factory=list)
    spins: dict[object, Spin] = field(default_factory=dict)
    spins_over: int = 0
    inside_spins: list[InsideSpin] = field(default_factory=list)
    message_waits: list[Any] = field(default_factory=list)
    ends: list[End] = field(default_factory=list)
    context: Instance | None = None
    thread: int = 0
    threads: int = 0
    executors: list[Instance] = field(default_factory=list)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    called: dict[int, Function] = field(default_factory=dict)
    without_caller: dict[int, set[int]] = field(default_factory=dict)
    decorated: list[Function] = field(default_factory=list)
    decorated_classes: list[Class] = field(default_factory=list)
    escaped: list[tuple[Value, Place]] = field(default_factory=list)
    exit_hooks: list[tuple[Value, Call]] = field(default_factory=list)
    signal_handlers: list[ActivityState] = field(default_factory=list)
    interruptible: set[int] = field(default_factory=set)
    instances: list[Instance] = field(default_factory=list)
    subclasses: dict[Class, list[Class]] = field(default_factory=dict)
    made_of: Counter[Class] = field(default_factory=Counter)
    followed_later: Counter[Value] = field(default_factory=Counter)
    settled: dict[int, int] = field(default_factory=dict)
    ghosts: dict[str, Instance] = field(default_factory=dict)
    times: int = 1
    round: tuple[int, ...] = ()
    iterating: str | None = None
    refilling: bool = False
    moves: str | None = None
    looking: tuple[tuple[int, str], ...] = ()
    made_by_looking: dict[object, Instance] = field(default_factory=dict)
    same_unknowns: dict[Unknown, Mystery] = field(default_factory=dict)
    unknown_groups: dict[object, Instance] = field(default_factory=dict)
    kept: list[Value] = field(default_factory=list)
    kept_in: dict[Value, tuple[Heaped, str]] = field(default_factory=dict)
    met_meanwhile: dict[tuple[Heaped, str], dict[object, Instance]] = field(default_factory=dict)
    left_callbacks: list[Any] = field(default_factory=list)
    completed: set[int] = field(default_factory=set)
    callback_path: Path = ()
    shutting_down: bool = False
    followed: int = 0
    cut: list[Cut] = field(default_factory=list)
    made_in_callbacks: dict[object, Instance] = field(default_factory=dict)
    by_node: dict[int, list[EntityState]] = field(default_factory=dict)
    lists_builtin: bool = False
    builtins: list[EntityState] = field(default_factory=list)
    global_executor: Instance | None = None
    groupless: Instance | None = None
    trees: list[ast.Module] = field(default_factory=list)
    files: list[tuple[ast.Module, str]] = field(default_factory=list)
    changing: int = 0
    unset: int = 0
    lacking: list[tuple[Heaped, str | None]] = field(default_factory=list)
    missing: set[Place] = field(default_factory=set)
    again: bool = False
    made_then: dict[object, Instance] = field(default_factory=dict)
    parts: dict[int, list[Instance]] = field(default_factory=dict)
    stored: dict[tuple[Value, str], dict[Place, Value]] = field(default_factory=dict)
    trying: tuple[int, int] | None = None
    tries: int = 0
    met: dict[tuple[Heaped, str], frozenset[object]] = field(default_factory=dict)
    met_by: dict[int, dict[tuple[Heaped, str], frozenset[object]]] = field(default_factory=dict)
    rounds: Counter[int] = field(default_factory=Counter)
    tested: Value | None = None
    conditions: dict[tuple[Place, int], str] = field(default_factory=dict)
    plain: dict[int, bool] = field(default_factory=dict)
    plain_of: int = 0
    spent: Counter[int] = field(default_factory=Counter)
    doubted: dict[Value, str] = field(default_factory=dict)
    doubted_calls: Counter[Value] = field(default_factory=Counter)

    @property
    def in_callback(self) -> bool:
        """Whether a callback is followed, and no thread that it starts."""
        return self.deeds is not None and self.activity is None

    @property
    def spun_in_loop(self) -> bool:
        """Whether what is followed stands in a loop that has spun, and may again."""
        return self.open_loops > 0 and self.main_spins > self.before_loop
