"""
The one description of a node: what an executor serves, as frozen values.

A ``Spec`` is one verification unit: one executor with all nodes it serves. Values check
themselves; what could not be found out is ``Unknown``. This room knows nothing of syntax
trees, processes, UPPAAL text or YAML (``yaml_io.py`` is the only place that does).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from enum import Enum

from ros2cc_extract.errors import SpecFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Access, Act, Blocking, Waker
from ros2cc_extract.spec.function_names import name_in_module


class CallbackType(Enum):
    """The four callback types of the published model."""

    TMR = 'TMR'
    SUB = 'SUB'
    SRV = 'SRV'
    CLT = 'CLT'


class GroupType(Enum):
    """The two group types of the published model."""

    REENTRANT = 'REENTRANT'
    EXCLUSIVE = 'EXCLUSIVE'


class EntityKind(Enum):
    """What exactly a callback belongs to; the published type is only the nearest."""

    TIMER = 'timer'
    SUBSCRIPTION = 'subscription'
    SERVICE = 'service'
    CLIENT = 'client'
    GUARD_CONDITION = 'guard_condition'
    ACTION_SERVER = 'action_server'
    ACTION_CLIENT = 'action_client'
    WAITABLE = 'waitable'
    QOS_EVENT = 'qos_event'
    PARAMETER_SERVICE = 'parameter_service'
    LIFECYCLE_SERVICE = 'lifecycle_service'
    ACTION_EXECUTE = 'action_execute'
    DONE_CALLBACK = 'done_callback'
    TASK = 'task'

    @property
    def published_type(self) -> CallbackType:
        """The published type nearest to this kind."""
        return _PUBLISHED_TYPE[self]

    @property
    def key_name(self) -> str | None:
        """How the name of its topic, service or action is called; ``None`` if it has none."""
        return _KEY_NAME.get(self)

    @property
    def is_task(self) -> bool:
        """True for work that executors run without asking a group (rclpy, ``create_task``)."""
        return self in (EntityKind.ACTION_EXECUTE, EntityKind.DONE_CALLBACK, EntityKind.TASK)


_PUBLISHED_TYPE = {
    EntityKind.TIMER: CallbackType.TMR,
    EntityKind.SUBSCRIPTION: CallbackType.SUB,
    EntityKind.SERVICE: CallbackType.SRV,
    EntityKind.CLIENT: CallbackType.CLT,
    EntityKind.GUARD_CONDITION: CallbackType.SUB,
    EntityKind.ACTION_SERVER: CallbackType.SRV,
    EntityKind.ACTION_CLIENT: CallbackType.CLT,
    EntityKind.WAITABLE: CallbackType.SUB,
    EntityKind.QOS_EVENT: CallbackType.SUB,
    EntityKind.PARAMETER_SERVICE: CallbackType.SRV,
    EntityKind.LIFECYCLE_SERVICE: CallbackType.SRV,
    EntityKind.ACTION_EXECUTE: CallbackType.SRV,
    EntityKind.DONE_CALLBACK: CallbackType.CLT,
    EntityKind.TASK: CallbackType.TMR,
}

_KEY_NAME = {
    EntityKind.SUBSCRIPTION: 'topic',
    EntityKind.QOS_EVENT: 'topic',
    EntityKind.SERVICE: 'service',
    EntityKind.CLIENT: 'service',
    EntityKind.PARAMETER_SERVICE: 'service',
    EntityKind.LIFECYCLE_SERVICE: 'service',
    EntityKind.ACTION_SERVER: 'action',
    EntityKind.ACTION_CLIENT: 'action',
    EntityKind.ACTION_EXECUTE: 'action',
    EntityKind.DONE_CALLBACK: 'client',
}


class Origin(Enum):
    """Where a specification comes from."""

    STATIC = 'static'
    LIVE = 'live'
    MERGED = 'merged'
    MANUAL = 'manual'


class When(Enum):
    """When an entity comes into being."""

    START = 'start'
    LATER = 'later'
    CALLBACK = 'callback'
    CONFIGURE = 'configure'


@dataclass(frozen=True, kw_only=True)
class Distribution:
    """Measured times in seconds; median and p99 are of the last runs, the extremes of all."""

    min_s: float
    median_s: float
    p99_s: float
    max_s: float


@dataclass(frozen=True, kw_only=True)
class Measured:
    """
    What a live run measured of a callback.

    :param count: executions begun.
    :param refused: starts that the group refused.
    :param running: executions that had not ended when this was written.
    :param threads: how many different threads ran it.
    :param period: from one begin to the next.
    :param duration: from begin to end; of a coroutine with its waits.
    """

    count: int
    refused: int = 0
    running: int = 0
    threads: int = 0
    period: Distribution | None = None
    duration: Distribution | None = None


_WORDS = {
    EntityKind.CLIENT: 'client',
    EntityKind.ACTION_CLIENT: 'action client',
    EntityKind.ACTION_SERVER: 'action server',
}


@dataclass(frozen=True, kw_only=True)
class Callback:
    """
    One entity that an executor serves, or one piece of work outside every group.

    :param group: name of a group of the same unit.
    :param entity: exact kind; ``None`` in hand-written files of the published format.
    :param node: name of the ROS node it belongs to.
    :param function: qualified name of the function; ``None`` for a client without one.
    :param key: topic, service or action name; of a done-callback, that of the client it answers.
    :param period_s: seconds, of a timer; by hand also of what arrives for any other.
    :param duration_s: seconds of one run, as written down by hand.
    :param count: how many such entities one creation place makes.
    :param alternative: equal marks stand for exclusive branches.
    :param branch: which of these; callbacks of one branch are there together.
    :param cancelled: of a timer, code may cancel it, or it does not start by itself.
    :param takes_info: it needs information that only some releases pass to a function.
    :param askers: of a service, how many requests at a time may be on their way from the known
        clients, where several may.
    :param library: made by a library on the node's behalf (tf, message_filters …).
    :param builtin: made by rclpy itself; no user wrote it.
    :param pieces: objects that it publishes as a whole while others change them piece by piece, or
        the other way round; of a change, ``update`` is true.
    :param unresolved: why the callback function or its node could not be followed.
    :param assumed: the rule by which a fact about it was assumed.
    """

    name: str
    type: CallbackType
    group: str
    entity: EntityKind | None = None
    node: str | Unknown | None = None
    function: str | None = None
    cls: str | None = None
    key: str | Unknown | None = None
    period_s: float | Unknown | None = None
    duration_s: float | None = None
    count: int | Unknown = 1
    when: When = When.START
    conditional: bool = False
    alternative: str | None = None
    branch: int | None = None
    coroutine: bool = False
    one_shot: bool = False
    cancelled: bool = False
    takes_info: bool = False
    askers: int = 0
    destroyed: bool = False
    groupless: bool = False
    library: str | None = None
    builtin: bool = False
    unresolved: Unknown | None = None
    assumed: str | None = None
    source: Place | None = None
    defined: Place | None = None
    blocking: tuple[Blocking, ...] = ()
    reads: tuple[Access, ...] = ()
    writes: tuple[Access, ...] = ()
    locks: tuple[Act, ...] = ()
    publishes: tuple[Act, ...] = ()
    changes: tuple[Act, ...] = ()
    pieces: tuple[Access, ...] = ()
    measured: Measured | None = None

    @property
    def display_name(self) -> str:
        """
        How the callback is called in text for people: ``Arm.on_goal``, ``client 'plan'``.

        An action server has up to three functions, of which ``function`` is the first: it is
        called by the name of the action.
        """
        function = name_in_module(self.function, self.defined)
        if function == '<lambda>':
            at = self.defined or self.source
            return f'lambda at line {at.line}' if at else self.name
        if function is not None and self.entity is not EntityKind.ACTION_SERVER:
            return function
        words = _WORDS.get(self.entity) if self.entity else None
        return f'{words} {self.key!r}' if words and isinstance(self.key, str) else self.name

    @property
    def is_main(self) -> bool:
        """Whether it is what the program does on the loop that runs its nodes."""
        return self.entity is EntityKind.TASK and self.one_shot

    @property
    def function_name(self) -> str | None:
        """The bare name of its function."""
        return self.function.rpartition('.')[2] if self.function else None


def exclude_each_other(one: Callback, other: Callback) -> bool:
    """Whether only one of two callbacks is ever created."""
    if one.alternative is None or one.alternative != other.alternative:
        return False
    return one.branch is None or one.branch != other.branch


class ActivityKind(Enum):
    """What runs an activity."""

    MAIN = 'main'
    THREAD = 'thread'
    TIMER = 'timer'
    POOL = 'pool'
    PROCESS = 'process'


@dataclass(frozen=True, kw_only=True)
class Activity:
    """
    Code that runs beside the callbacks, on a thread that no executor has.

    It is in no group and needs no worker; it waits, holds, reads and writes as callbacks do.

    :param kind: ``MAIN`` is the code of the program after it has started a thread that spins.
    :param starts: what starts it and where, as wakers; empty for what runs from the beginning.
    :param count: how many may run at a time; ``conditional``: a branch may skip its start.
    :param daemon: the program ends without waiting for it; ``loops``: it never ends by itself.
    :param on_loop: a loop of asyncio runs it, on one thread with all else that it runs.
    :param ends_first: the set-up waits for its end, before anything spins.
    :param spins: where it runs the callbacks itself, if nothing else ever does, and one by one.
    :param source: where it is started; ``defined`` is its function.
    """

    name: str
    kind: ActivityKind
    function: str | None = None
    node: str | Unknown | None = None
    cls: str | None = None
    starts: tuple[Waker, ...] = ()
    count: int | Unknown = 1
    conditional: bool = False
    daemon: bool = False
    loops: bool | Unknown = False
    on_loop: bool = False
    ends_first: bool = False
    unresolved: Unknown | None = None
    source: Place | None = None
    defined: Place | None = None
    blocking: tuple[Blocking, ...] = ()
    reads: tuple[Access, ...] = ()
    writes: tuple[Access, ...] = ()
    locks: tuple[Act, ...] = ()
    publishes: tuple[Act, ...] = ()
    changes: tuple[Act, ...] = ()
    spins: tuple[Act, ...] = ()
    pieces: tuple[Access, ...] = ()

    @property
    def display_name(self) -> str:
        """How it is called in text for people: its function, else its name."""
        function = name_in_module(self.function, self.defined)
        return self.name if function is None or function == '<lambda>' else function


@dataclass(frozen=True, kw_only=True)
class CallbackGroup:
    """
    A callback group.

    :param type: with ``unresolved`` set it is the type assumed for models, EXCLUSIVE.
    :param default: the default group of ``node``.
    :param groupless: stands for work that is in no group at all (always REENTRANT).
    :param cls: class name where it is neither of rclpy's two.
    """

    name: str
    type: GroupType
    default: bool = False
    node: str | None = None
    groupless: bool = False
    library: str | None = None
    builtin: bool = False
    cls: str | None = None
    count: int | Unknown = 1
    unresolved: Unknown | None = None
    assumed: str | None = None
    source: Place | None = None

    @property
    def display_name(self) -> str:
        """How it is called in text for people, as ``the default group of 'arm'``."""
        if self.default and self.node:
            return f'the default group of {self.node!r}'
        return 'the default group' if self.default else f'group {self.name!r}'


OF_LOOP = 'asyncio'
"""The library of groups without a maker: each is an entity that a loop serves run by run."""

NO_EXECUTOR = 'no executor or spin found for this node'
"""The reason why an executor is unknown if the scan found none."""


@dataclass(frozen=True, kw_only=True)
class Executor:
    """
    The executor of the unit and its worker threads.

    :param kind: class name as in rclpy, or a custom one; ``None`` in the published format.
    :param import_caught: another takes its place where that class cannot be imported.
    :param threads: names of the worker threads, at least one.
    :param threads_source: a place as text, or ``default_cpu_count``: rclpy takes that at run time.
    :param unresolved: why the executor, its kind or its thread count could not be followed.
    :param spun: how it is run: ``rclpy.spin``, ``spin_once`` …
    :param alternative: as of a callback: units of equal marks are never run together.
    """

    name: str
    threads: tuple[str, ...]
    kind: str | Unknown | None = None
    import_caught: bool = False
    threads_source: str | None = None
    in_thread: bool = False
    spun: str | None = None
    alternative: str | None = None
    branch: int | None = None
    unresolved: Unknown | None = None
    assumed: str | None = None
    source: Place | None = None


@dataclass(frozen=True, kw_only=True)
class Unresolved:
    """
    One line of the list of what could not be found out.

    :param subject: name of the callback, group or executor, or a dotted source name.
    :param fact: which of its facts: ``group``, ``topic``, ``threads``, ``function`` …
    """

    subject: str
    fact: str
    reason: str
    source: Place | None = None


@dataclass(frozen=True, kw_only=True)
class Spec:
    """
    One verification unit.

    :param name: UPPAAL identifier; with several nodes the name of the unit.
    :param activities: threads of the program's own, and ``main``, that run beside the executor.
    :param handed: functions that code which is not scanned has, and may call on any thread.
    :param set_up: waits of the code that sets the unit up or ends it: ``main``, constructors, what
        no known code calls. They hold up only that code, and no model has them.
    :param nodes: the ROS nodes served, in the order of ``add_node``.
    :param entry: where this set-up starts (``arm.py:main``); those of one file are alternatives.
    :param rclpy: version of rclpy the facts are tied to, where known.
    :raises SpecFormatError: on a duplicate name or a group that is not declared.
    """

    name: str
    callbacks: tuple[Callback, ...]
    groups: tuple[CallbackGroup, ...]
    executor: Executor
    activities: tuple[Activity, ...] = ()
    handed: tuple[Activity, ...] = ()
    set_up: tuple[Blocking, ...] = ()
    origin: Origin = Origin.MANUAL
    nodes: tuple[str, ...] = ()
    sources: tuple[str, ...] = ()
    entry: str | None = None
    rclpy: str | None = None
    unresolved: tuple[Unresolved, ...] = ()

    def __post_init__(self) -> None:
        declared = {group.name for group in self.groups}
        for callback in self.callbacks:
            if callback.group not in declared:
                raise SpecFormatError(
                    f'callback {callback.name!r} is in group {callback.group!r}, which is not '
                    'declared',
                    callback.source,
                    f'add it under callback_groups or use one of {_listing(declared)}',
                )
        for name, uses in Counter(self.names()).items():
            if uses > 1:
                raise SpecFormatError(
                    f'name {name!r} is used {uses} times', None, 'names must be unique in a unit'
                )

    def names(self) -> Iterable[str]:
        """All names of the unit; they share one name space, as in the published format."""
        yield self.name
        yield from (callback.name for callback in self.callbacks)
        yield from (group.name for group in self.groups)
        yield from (self.executor.name, *self.executor.threads)
        yield from (activity.name for activity in (*self.activities, *self.handed))

    @property
    def has_work(self) -> bool:
        """Whether a user wrote some of what it runs, not only rclpy."""
        return bool(self.activities) or any(not each.builtin for each in self.callbacks)

    def group_of(self, callback: Callback) -> CallbackGroup:
        """The group a callback of this unit is in."""
        return next(group for group in self.groups if group.name == callback.group)


def collect_unresolved(spec: Spec) -> tuple[Unresolved, ...]:
    """List every fact of ``spec`` that is ``Unknown``, callbacks first, in order."""
    found: list[Unresolved] = []
    for callback in spec.callbacks:
        found.extend(
            _unresolved(callback.name, callback.source, fact, value)
            for fact, value in (
                ('function', callback.unresolved),
                ('node', callback.node),
                (_key_fact(callback), callback.key),
                ('period', callback.period_s),
                ('count', callback.count),
            )
            if isinstance(value, Unknown)
        )
    for group in spec.groups:
        found.extend(
            _unresolved(group.name, group.source, fact, value)
            for fact, value in (('group', group.unresolved), ('count', group.count))
            if isinstance(value, Unknown)
        )
    executor = spec.executor
    if isinstance(executor.kind, Unknown):
        found.append(_unresolved(executor.name, executor.source, 'executor', executor.kind))
    if executor.unresolved is not None:
        found.append(_unresolved(executor.name, executor.source, 'executor', executor.unresolved))
    return tuple(found)


def _key_fact(callback: Callback) -> str:
    return (callback.entity.key_name if callback.entity else None) or 'key'


def _unresolved(subject: str, source: Place | None, fact: str, value: Unknown) -> Unresolved:
    return Unresolved(subject=subject, fact=fact, reason=value.reason, source=value.at or source)


def _listing(names: Iterable[str]) -> str:
    return ', '.join(sorted(names)) or '(none)'
