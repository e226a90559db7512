"""What a program makes of rclpy in one run: its nodes, entities, groups, executors and spins."""

from __future__ import annotations

from dataclasses import field

from ros2cc_extract.extract.static.concurrency.machine.state import (
    ActivityState,
    ConcurrentWorld,
    OutsideWait,
    Over,
    TimedJoin,
)
from ros2cc_extract.extract.static.program.given_parameters import NONE_GIVEN, GivenParameters
from ros2cc_extract.extract.static.python.machine.library_state import LibraryState
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer, EffectLog
from ros2cc_extract.extract.static.python.values.values import (
    Const,
    Instance,
    Path,
    Value,
    options_of,
)
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.client_server_pairs import SERVER_KINDS
from ros2cc_extract.spec.model import EntityKind, GroupType, When

LOOP_KIND = 'AsyncNode'
"""Kind of the executor that stands for a loop of asyncio, by the nodes that it runs."""
_MERGED = (EntityKind.TASK, EntityKind.DONE_CALLBACK)


@dataclass(eq=False)
class GroupState(LibraryState):
    """
    A callback group.

    :param node: the node whose default group it is.
    :param unresolved: why it could not be followed, or why its type is not certain.
    """

    is_known_by_name = True

    type: GroupType = GroupType.EXCLUSIVE
    node: Instance | None = None
    default: bool = False
    groupless: bool = False
    unresolved: Unknown | None = None
    library: str | None = None
    custom: str | None = None
    count: int | Unknown = 1


@dataclass(eq=False)
class NodeState(LibraryState):
    """
    A ROS node.

    :param name: value of the name argument; ``None`` when none was seen.
    :param namespace: value of that argument.
    :param ghost: why it is not known which node it is; set for a node handed in from outside.
    :param takes_any_parameter: its code may ask for parameters whose names are not known.
    :param has_own_arguments: it is made with arguments that stand for those of its process.
    :param parameter_callbacks: what runs when parameters are set, by stage, the latest first.
    :param more: why it may have entities that we do not see.
    :param begun: the call of ``Node.__init__``.
    :param nested: a spin inside a callback that serves it, and where.
    :param loop: the loop of asyncio whose thread spins it.
    :param changes_own_state: the code runs its transitions itself.
    :param sim_clock: the subscription that moves its clock, where it uses simulated time.
    """

    is_made_once = True
    is_unit_of_its_own = True

    default_group: Instance
    name: Value | None = None
    namespace: Value | None = None
    ghost: Unknown | None = None
    lifecycle: bool = False
    changes_own_state: bool = False
    on_asyncio: bool = False
    rate_group: Instance | None = None
    has_parameter_services: bool = True
    takes_any_parameter: bool = False
    has_own_arguments: bool = False
    parameter_callbacks: dict[str, list[Value]] = field(default_factory=dict)
    more: list[tuple[str, Place | None]] = field(default_factory=list)
    spun: bool = False
    begun: Place | None = None
    nested: tuple[str, Place] | None = None
    sim_clock: EntityState | None = None
    loop: Place | None = None
    count: int | Unknown = 1

    def owner_of(self, thing: Instance) -> Instance | None:
        """The node itself."""
        return thing

    def note_passed(self, function: str, place: Place) -> None:
        """Note that code that has it may make entities of it."""
        self.more.append((f'the node is passed to {function}, which is not scanned', place))

    def doubt(self, reason: str, place: Place | None) -> None:
        """It may have entities that are not seen."""
        self.more.append((reason, place))


@dataclass(eq=False)
class ExecutorState(LibraryState):
    """
    An executor; its slot ``nodes`` holds the nodes it has, in order.

    :param threads: number of worker threads, ``None`` for the number of CPUs at run time.
    :param unresolved: why its kind or thread count could not be followed.
    """

    is_block = True
    is_known_by_name = True
    is_unit_of_its_own = True

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
class EntityState(Doer, LibraryState):
    """
    A ROS entity or a piece of group-less work; one record for each that is made.

    :param type: its class of messages, services or actions; ``qos`` as it was given.
    :param assumed: the rule by which it is assumed to be there.
    :param held: flags that its maker has handed over to it, see ``flag_locks.py``.
    :param ran: how many of its functions were followed; -1 before any is.
    :param maker: the callback or activity that makes it, if any does.
    :param part_of: the subscription whose event it handles.
    :param called_under: the lock that a library holds while it calls one of the functions;
        ``None`` where it depends on the caller.
    :param cancelled: some code cancels it.
    :param dormant: where it is made so that it does not start by itself, or is cancelled at once.
    :param restarted: somebody starts it, or starts it again.
    :param takes_info: a function of it needs what only some releases pass (``unfit_callbacks``).
    :param is_set_up: it is what the set-up does beside the callbacks, on their loop, and is
        followed where it stands.
    :param surely_waits: waits of its first run which only later runs could end.
    :param after: how many waits of the set-up were noted before it was made.
    """

    is_one_of_many = True

    kind: EntityKind
    node: Instance
    group: Instance
    place: Place
    callback: Value | None = None
    key: Value | None = None
    type: Value | None = None
    qos: Value | None = None
    period: Value | None = None
    path: Path = ()
    count: int | Unknown = 1
    when: When = When.START
    library: str | None = None
    builtin: bool = False
    destroyed: bool = False
    one_shot: bool = False
    cancelled: bool = False
    dormant: Place | None = None
    restarted: bool = False
    takes_info: bool = False
    is_set_up: bool = False
    surely_waits: set[object] = field(default_factory=set)
    label: str | None = None
    extra_callbacks: tuple[Value, ...] = ()
    ran: int = -1
    effects: EffectLog | None = None
    argument: Value | None = None
    goal_callback: Value | None = None
    defers: bool = False
    held: tuple[str, ...] | None = None
    number: int = 0
    after: int = 0
    maker: object = None
    part_of: EntityState | None = None
    assumed: str | None = None
    called_under: dict[Value, Instance | None] = field(default_factory=dict)

    @property
    def owner(self) -> Instance | None:
        """Its node."""
        return self.node

    @property
    def topic(self) -> str:
        """The name that it was made with."""
        return str(self.key.value) if isinstance(self.key, Const) else ''

    @property
    def kind_name(self) -> str:
        """What a specification calls its kind."""
        return self.kind.value

    @property
    def has_own_text(self) -> bool:
        """Whether it is made in the set-up, for one value, and is not merged with others."""
        return self.kind not in _MERGED and self.when is not When.CALLBACK

    @property
    def is_answered(self) -> bool:
        """Whether it is a client."""
        return self.kind in SERVER_KINDS

    @property
    def is_on_loop(self) -> bool:
        """Whether asyncio runs its node."""
        return isinstance(self.node.state, NodeState) and self.node.state.on_asyncio

    def owner_of(self, thing: Instance) -> Instance | None:
        """Its node."""
        return self.node


@dataclass(frozen=True, eq=False)
class PublisherState:
    """A publisher as it was made: its arguments, and the branches that led there."""

    node: Instance
    topic: Value | None
    type: Value | None
    qos: Value | None
    place: Place
    path: Path


@dataclass(eq=False)
class Spin:
    """
    One spin call: the executor, the nodes it has then, and how it is called.

    :param thread: which thread does it, 0 for the one of the set-up.
    :param from_callback: that thread is one that a callback starts.
    :param over: how many of the spins before it were over then.
    :param is_tried: what rises out of it may be caught.
    :param by: the thread of the program's own that does it.
    :param takes: it adds its node to the executor, out of any other, and removes it at its end.
    :param beside: other threads that come to it and that it is not over for.
    :param chains: the calls that lead to it.
    :param may_have_loop: a loop of asyncio may run what calls it.
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
    by: ActivityState | None = None
    takes: bool = False
    beside: list[ActivityState] = field(default_factory=list)
    chains: dict[tuple[Place, ...], None] = field(default_factory=dict)
    may_have_loop: bool = False

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
    :param nodes: those that it has then.
    :param is_for_library: a library spins, until somebody outside answers.
    """

    entity: EntityState
    executor: Instance
    how: str
    timeout: Value | None
    place: Place
    held: tuple[str, ...]
    nodes: tuple[Instance, ...] = ()
    is_for_library: bool = False


@dataclass(frozen=True, eq=False)
class End:
    """
    A callback, or a thread of the program's own, ends something that is served.

    :param what: the node, executor or entity.
    :param text: what is done, where that is no end but comes after one.
    :param behind: the last wait of ``doer`` before it, see ``EffectLog.behind``.
    :param locks: held at that place.
    :param over: what the program has ended by then.
    :param is_limited: it waits for the callbacks that run, but not forever.
    """

    kind: str
    what: Instance | EntityState | None
    doer: EntityState | ActivityState
    place: Place
    text: str = ''
    behind: object = None
    locks: tuple[str, ...] = ()
    over: tuple[Over, ...] = ()
    timed_joins: tuple[TimedJoin, ...] = ()
    is_limited: bool = False


@dataclass(frozen=True, eq=False)
class NodeEnd:
    """
    The main program destroys a node.

    :param over: the threads that have ended, as far as it has waited for them, by identity.
    """

    node: Instance
    place: Place
    over: frozenset[int]


@dataclass(frozen=True, eq=False)
class MessageWait:
    """
    A message of ``node`` is waited for.

    :param by: the callback that waits; ``None`` for a thread or ``main``.
    :param thread: which one it is, as ``ConcurrentWorld.thread`` counts them.
    """

    node: Instance
    outside: OutsideWait
    by: EntityState | None
    thread: int
    has_limit: bool


@dataclass
class RosWorld(ConcurrentWorld):
    """
    One run, with what it makes of rclpy.

    :param current: the callback that is followed.
    :param admitted: flags that hold for an accepted goal, by node and place of the action server.
    :param open_to: those that were down when a goal was accepted, by the same.
    :param message_waits: the waits for a message, with their nodes, see ``taken_messages.py``.
    :param publishers: by node, place and topic.
    :param parameters: what a launch sets for the nodes.
    :param loops: the executor that stands for a loop of asyncio, by where that begins.
    :param lists_builtin: whether ``builtins`` gets what rclpy makes by itself.
    """

    current: EntityState | None = None
    admitted: dict[tuple[Instance, Place], tuple[str, ...]] = field(default_factory=dict)
    open_to: dict[tuple[Instance, Place], frozenset[str]] = field(default_factory=dict)
    nodes: list[Instance] = field(default_factory=list)
    entities: list[EntityState] = field(default_factory=list)
    publishers: dict[object, PublisherState] = field(default_factory=dict)
    spins: dict[object, Spin] = field(default_factory=dict)
    inside_spins: list[InsideSpin] = field(default_factory=list)
    message_waits: list[MessageWait] = field(default_factory=list)
    ends: list[End] = field(default_factory=list)
    node_ends: list[NodeEnd] = field(default_factory=list)
    context: Instance | None = None
    executors: list[Instance] = field(default_factory=list)
    ghosts: dict[str, Instance] = field(default_factory=dict)
    unknown_groups: dict[object, Instance] = field(default_factory=dict)
    shutting_down: bool = False
    followed: int = 0
    by_node: dict[int, list[EntityState]] = field(default_factory=dict)
    lists_builtin: bool = False
    parameters: GivenParameters = NONE_GIVEN
    builtins: list[EntityState] = field(default_factory=list)
    global_executor: Instance | None = None
    loops: dict[object, Instance] = field(default_factory=dict)
    groupless: Instance | None = None

    @property
    def has_let_others_run(self) -> bool:
        """Whether something has been spun."""
        return bool(self.spins)

    @property
    def own_loop(self) -> Place | None:
        """That of the node whose callback is followed, or of the set-up."""
        if self.is_on_loop and self.current is not None:
            state = self.current.node.state
            return state.loop if isinstance(state, NodeState) else None
        return self.loop

    @property
    def spins_begun(self) -> int:
        """How many spins there were, in any thread."""
        return len(self.spins)

    @property
    def things_made(self) -> int:
        """How many entities there are."""
        return len(self.entities) + len(self.builtins)

    def served_within(self, file: str, first: int, last: int) -> tuple[Instance, ...]:
        """The nodes that are spun within these lines."""
        return tuple(
            node
            for spin in self.spins.values()
            if spin.place.file == file and first <= spin.place.line <= last
            for node in spin.nodes
        )


def nodes_of(executor: Instance) -> tuple[Instance, ...]:
    """The nodes an executor has, in the order in which they were added."""
    found: list[Instance] = []
    for entry in executor.slots.get('__nodes__', ()):
        found.extend(o for o in options_of(entry) if isinstance(o, Instance) and o not in found)
    return tuple(found)
