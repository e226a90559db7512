"""
One record for each executor, node, group, entity and task seen.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. Objects of the program are held by weak references, so that nothing lives longer
than without us.
"""

from __future__ import annotations

import time
import weakref
from collections.abc import Callable, Sequence
from typing import Any

from .frames import Creation, FunctionName, RawPlace, class_name, name_function
from .interfaces import PublisherRecord, qos_of, type_of
from .timings import Timings

_KINDS = {
    'Timer': 'timer',
    'Subscription': 'subscription',
    'GuardCondition': 'guard_condition',
    'Client': 'client',
    'Service': 'service',
    'EventHandler': 'qos_event',
    'ActionServer': 'action_server',
    'ActionClient': 'action_client',
}
WAITABLE_KINDS = frozenset({'action_server', 'action_client', 'waitable'})
# rclpy's modules whose entities no user wrote, with their kinds.
_BUILTIN_MODULES = {
    'parameter_service': 'parameter_service',
    'type_description_service': 'service',
    'logging_service': 'service',
    'time_source': 'subscription',
    'lifecycle.node': 'lifecycle_service',
}
# rclpy's modules whose entities the user asked for indirectly.
_LIBRARY_MODULES = ('parameter_client', 'parameter_event_handler')


def _ending(record: ExecutorRecord | NodeRecord | EntityRecord) -> Callable[[Any], None]:
    """Note when an object ends: as late as the interpreter itself, when modules are empty."""
    clock = time.monotonic_ns

    def end(_: Any) -> None:
        record.died = clock()

    return end


class ExecutorRecord:
    """An executor; ``default_threads`` when its program left the number to rclpy."""

    def __init__(self, number: int, executor: Any, created: RawPlace | None) -> None:
        self.number = number
        self.died: int | None = None
        self.ref = weakref.ref(executor, _ending(self))
        self.cls = class_name(executor)
        self.bases = [base.__name__ for base in type(executor).__mro__]
        self.own_class = not type(executor).__module__.startswith('rclpy')
        self.created = created
        self.default_threads = False
        self.threads: int | None = None
        self.spun: str | None = None
        self.in_thread: bool | None = None

    def signature(self) -> tuple[Any, ...] | None:
        """Equal for executors that one line of the program has made."""
        if self.created is None:
            return None
        return self.cls, self.created, self.threads, self.default_threads


class NodeRecord:
    """A node and the executors it was in, one after the other."""

    def __init__(self, number: int, node: Any) -> None:
        self.number = number
        self.died: int | None = None
        self.ref = weakref.ref(node, _ending(self))
        self.cls = class_name(node)
        self.name: str | None = None
        self.namespace: str | None = None
        self.default_group: int | None = None
        self.stays: list[Stay] = []
        # Functions that services of rclpy call: kind, function, number of the group.
        self.called: list[tuple[str, FunctionName, int]] = []
        # By what is the same for the same publisher, whether it still exists or not.
        self.publishers: dict[str, PublisherRecord] = {}

    def enter(self, executor: int) -> bool:
        """Note that the node is in an executor now; whether it has never been there before."""
        known = next((stay for stay in self.stays if stay.executor == executor), None)
        if known is None:
            self.stays.append(Stay(executor))
            return True
        known.resume()
        return False

    def leave(self, executor: int, *, waited: bool) -> bool:
        """Note that the node is no longer there; whether that happens for the first time."""
        for stay in self.stays:
            if stay.until is None and stay.executor == executor:
                stay.until = time.monotonic_ns()
                stay.waited = stay.waited or waited
                return not stay.resumed
        return False

    def signature(self) -> tuple[Any, ...] | None:
        """Equal for nodes that the program has made one after the other."""
        if self.name is None:
            return None
        return self.cls, self.name, self.namespace, *sorted(each.executor for each in self.stays)

    def move(self, executor: ExecutorRecord, to: int) -> None:
        """Count the stay in one executor, which is gone, as one in another."""
        for stay in [stay for stay in self.stays if stay.executor == executor.number]:
            stay.until = stay.span(executor.died)[1]
            known = next((each for each in self.stays if each.executor == to), None)
            if known is None:
                stay.executor = to
            else:
                self.stays.remove(stay)
                known.extend(stay, executor.died)

    def swallow(self, other: NodeRecord) -> None:
        """Go on as another node, after both are gone; they were in the same executors."""
        for stay in self.stays:
            for more in other.stays:
                if more.executor == stay.executor:
                    stay.until = stay.span(self.died)[1]
                    stay.extend(more, other.died)
        self.called = self.called or other.called
        self.died = other.died


class Stay:
    """
    A node's time in one executor, however often it has come and gone.

    :param since: moved on while the node was away, so that the stay is as long as all together.
    """

    def __init__(self, executor: int) -> None:
        self.executor = executor
        self.since = self.first = time.monotonic_ns()
        self.until: int | None = None
        self.waited = False
        self.resumed = False

    def resume(self) -> None:
        if self.until is not None:
            self.since += time.monotonic_ns() - self.until
            self.until, self.resumed = None, True

    def span(self, died: int | None) -> tuple[int, int]:
        """Give the first begin and the last end; one that goes on ends with what has died."""
        until = self.until if self.until is not None else died
        return self.first, time.monotonic_ns() if until is None else until

    def extend(self, later: Stay, died: int | None) -> None:
        """Add a stay that began after this one, which has ended."""
        begin, end = self.span(None)
        more = later.span(died)[1]
        length = end - self.since + more - later.since
        self.first, self.until = min(begin, later.first), max(end, more)
        self.since = self.until - length
        self.waited = self.waited or later.waited


class GroupRecord:
    """A callback group; ``kind`` is ``exclusive``, ``reentrant`` or ``own``."""

    def __init__(self, number: int, group: Any, creation: Creation | None) -> None:
        self.number = number
        self.ref = weakref.ref(group)
        self.cls = class_name(group)
        self.kind = _GROUP_KINDS.get(self.cls, 'own')
        if not type(group).__module__.startswith('rclpy'):
            self.kind = 'own'
        self.creation = creation
        self.node: int | None = None
        self.default = False
        self.rate = False

    def signature(self) -> tuple[Any, ...]:
        """Equal for groups that one line of the program has made."""
        place = self.creation.place if self.creation else None
        return self.kind, self.cls, self.default, self.rate, place


_GROUP_KINDS = {
    'MutuallyExclusiveCallbackGroup': 'exclusive',
    'ReentrantCallbackGroup': 'reentrant',
}


class EntityRecord:
    """An entity; what it is gets filled in once, as soon as the object is complete."""

    def __init__(self, number: int, entity: Any, group: int) -> None:
        self.number = number
        self.born = time.monotonic_ns()
        self.died: int | None = None
        self.ref = weakref.ref(entity, _ending(self))
        self.group = group
        self.node: int | None = None
        self.creation: Creation | None = None
        self.late = False
        self.complete = False
        self.kind = _KINDS.get(class_name(entity), 'waitable')
        self.cls = class_name(entity)
        self.key: str | None = None
        self.resolved_key: str | None = None
        self.type: str | None = None
        self.qos: dict[str, Any] | None = None
        self.period_ns: int | None = None
        self.function: FunctionName | None = None
        # What an action server runs as a task, in no group.
        self.execute: FunctionName | None = None
        self.builtin = False
        self.library: str | None = None
        # The object no longer exists; its node has let go of it while living on.
        self.gone = False
        self.destroyed = False
        self.made = 1
        self.timings = Timings()
        # Its text in the recording, with the state that it was written for.
        self.text: tuple[tuple[int, ...], str] | None = None

    def state(self) -> tuple[int, ...]:
        """Differ whenever anything that is written of it may have changed."""
        timings = self.timings
        flags = self.complete, self.destroyed, self.late, self.creation is None
        measured = timings.runs, timings.durations.count, timings.refused
        return *flags, *measured, self.made, self.node or 0, self.group

    def signature(self) -> tuple[Any, ...]:
        """Equal for entities that one line of the program makes again and again."""
        return self.group, *self.signature_in_any_group()

    def signature_in_any_group(self) -> tuple[Any, ...]:
        """Equal also where that line makes a group for each of them."""
        place = self.creation.place if self.creation else None
        name = self.function.name if self.function else None
        return self.kind, self.node, place, self.key, self.period_ns, name


class TaskRecord:
    """Work outside every group: created tasks, done-callbacks."""

    def __init__(self, number: int, kind: str, function: FunctionName, executor: int) -> None:
        self.number = number
        self.kind = kind
        self.function = function
        self.executor = executor
        self.node: int | None = None
        self.count = 0
        self.timings = Timings()


def has_waited(executor: Any) -> bool:
    """Whether an executor has ever waited for work (``executors.py``: it keeps its arguments)."""
    try:
        return executor._last_args is not None
    except AttributeError:
        return True


def thread_count(executor: Any) -> int | None:
    """
    Give the number of threads that run callbacks; ``None`` for classes we do not know.

    ``MultiThreadedExecutor`` has no public attribute for it (rclpy 3.3 to 9.1, ``executors.py``).
    """
    workers = getattr(getattr(executor, '_executor', None), '_max_workers', None)
    if isinstance(workers, int):
        return workers
    return 1 if type(executor).__module__.startswith('rclpy') else None


def fill_node(record: NodeRecord, node: Any) -> None:
    """Note the names while they can be had: a destroyed node raises when asked."""
    if record.name is None:
        try:
            record.name = node.get_name()
            record.namespace = node.get_namespace()
        except Exception:  # InvalidHandle cannot be imported here
            return


def note_publishers(record: NodeRecord, node: Any) -> bool:
    """Note the publishers of a node; whether one is new."""
    found = {}
    for publisher in list(getattr(node, 'publishers', ())):
        try:
            each = PublisherRecord(publisher)
        except Exception:  # a destroyed one raises InvalidHandle, which cannot be imported here
            continue
        found[f'{each.resolved_key or each.key} {each.type}'] = each
    new = {key: each for key, each in found.items() if key not in record.publishers}
    record.publishers.update(new)
    return bool(new)


def fill_entity(record: EntityRecord, entity: Any) -> None:
    creation = record.creation or Creation()
    _fill_key(record, entity, creation)
    record.type, record.qos = type_of(entity), qos_of(entity)
    record.function = _function_of(entity) or name_function(creation.callback)
    given = creation.execute_callback or getattr(entity, '_execute_callback', None)
    record.execute = name_function(given)
    creation.callback = creation.execute_callback = None
    record.library = creation.library
    through = creation.through
    if not through and record.function is not None and _is_of_rclpy(record.function):
        through = [record.function.module.removeprefix('rclpy.')]
    _judge_modules(record, through)
    if 'create_rate' in creation.functions:
        record.library = 'rclpy.create_rate'
    if record.function is not None and _is_of_rclpy(record.function):
        # What rclpy does at QoS events is its own, for every publisher and subscription.
        is_default = record.library is None or record.kind == 'qos_event'
        record.builtin = record.builtin or is_default
    if record.kind == 'qos_event' and not record.builtin:
        record.key = creation.topic
    record.complete = True


def _judge_modules(record: EntityRecord, through: Sequence[str]) -> None:
    """Find the maker of an entity: the innermost module that makes entities of its own."""
    for module in through:
        if module in _BUILTIN_MODULES:
            record.builtin = True
            if record.kind != 'qos_event':
                record.kind = _BUILTIN_MODULES[module]
            return
        if module in _LIBRARY_MODULES:
            record.library = record.library or f'rclpy.{module}'
            return


def _function_of(entity: Any) -> FunctionName | None:
    """Name the callback; of an action server the first that is not rclpy's own default."""
    names = ['callback', '_goal_callback', '_cancel_callback', '_handle_accepted_callback']
    found = [name_function(getattr(entity, name, None)) for name in names]
    given = [function for function in found[1:] if function and not _is_of_rclpy(function)]
    return found[0] or next(iter(given), None)


def _is_of_rclpy(function: FunctionName) -> bool:
    return function.module.partition('.')[0] == 'rclpy'


def _fill_key(record: EntityRecord, entity: Any, creation: Creation) -> None:
    for name in ('topic', 'srv_name', '_action_name'):
        value = getattr(entity, name, None)
        if isinstance(value, str):
            record.key = value
            break
    else:
        record.key = creation.action_name
    for name in ('topic_name', 'service_name'):
        value = getattr(entity, name, None)
        if isinstance(value, str):
            record.resolved_key = value
    if record.kind == 'timer':
        try:
            record.period_ns = entity.timer_period_ns
        except Exception:  # a destroyed one raises InvalidHandle, which cannot be imported here
            return
