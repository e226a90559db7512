"""From the recording of a process to specifications: one for each executor that held nodes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from ros2cc_extract.extract.live.recordings.recording import (
    Function,
    RecordedCalled,
    RecordedEntity,
    RecordedExecutor,
    RecordedGroup,
    RecordedNode,
    RecordedTask,
    Recording,
    Stay,
)
from ros2cc_extract.extract.names import Names, Wanted, unique_names
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Origin,
    Spec,
    When,
    collect_unresolved,
)

# rclpy's own default where the number of CPUs cannot be had; the number seen is used instead.
DEFAULT_COUNT = 'default_cpu_count'

_ORDER = (
    EntityKind.TIMER,
    EntityKind.SUBSCRIPTION,
    EntityKind.GUARD_CONDITION,
    EntityKind.SERVICE,
    EntityKind.CLIENT,
    EntityKind.ACTION_SERVER,
    EntityKind.ACTION_CLIENT,
    EntityKind.WAITABLE,
    EntityKind.PARAMETER_SERVICE,
    EntityKind.LIFECYCLE_SERVICE,
    EntityKind.QOS_EVENT,
    EntityKind.ACTION_EXECUTE,
    EntityKind.DONE_CALLBACK,
    EntityKind.TASK,
)
_LABEL_ENDS = {
    EntityKind.CLIENT: 'client',
    EntityKind.ACTION_CLIENT: 'action_client',
    EntityKind.ACTION_SERVER: 'action_server',
    EntityKind.QOS_EVENT: 'event',
}


def specs_of(recording: Recording) -> tuple[Spec, ...]:
    """Give the units of one process, in the order their executors were made."""
    homes = {node.number: home_of(node) for node in recording.nodes}
    units = []
    for executor in recording.executors:
        nodes = [node for node in recording.nodes if homes[node.number] == executor.number]
        if nodes:
            units.append(_Unit(recording, executor, nodes).build())
    return tuple(units)


def home_of(node: RecordedNode) -> int | None:
    """
    Choose the executor that a node belongs to: of those that ran it the one it was in longest.

    ``rclpy.spin`` takes a node out again when it ends, and a nested spin takes it out of its own
    executor for good, so its place at the end proves nothing.
    """
    served = [stay for stay in node.stays if stay.waited] or list(node.stays[-1:])
    if not served:
        return None
    return max(served, key=_length).executor


def _length(stay: Stay) -> tuple[bool, int]:
    if stay.until_ns is None:
        return True, -stay.since_ns
    return False, stay.until_ns - stay.since_ns


class _Unit:
    """Builds the specification of one executor with its nodes."""

    def __init__(
        self, recording: Recording, executor: RecordedExecutor, nodes: Sequence[RecordedNode]
    ) -> None:
        self._recording = recording
        self._executor = executor
        self._nodes = nodes
        self._taken = Names()
        self._node_names = _node_names(nodes)
        self._group_names: dict[int, str] = {}

    def build(self) -> Spec:
        names = tuple(self._node_names.values())
        name = self._taken.take(names[0] if len(names) == 1 else self._unit_label())
        threads = self._thread_names()
        drafts = sorted(self._drafts(), key=self._serving_order)
        labels = unique_names([self._wanted(draft) for draft, _ in drafts], self._taken)
        groups = self._groups(drafts, labels)
        callbacks = tuple(
            replace(draft, name=label, group=self._group_names[group])
            for (draft, group), label in zip(drafts, labels, strict=True)
        )
        spec = Spec(
            name=name,
            callbacks=callbacks,
            groups=tuple(groups),
            executor=self._executor_value(threads),
            origin=Origin.LIVE,
            nodes=names,
            sources=_sources(callbacks),
            rclpy=self._recording.rclpy,
        )
        return replace(spec, unresolved=collect_unresolved(spec))

    def _unit_label(self) -> str:
        created = self._executor.created
        stem = created.file.rpartition('/')[2].removesuffix('.py') if created else ''
        return stem or 'unit'

    def _thread_names(self) -> tuple[str, ...]:
        number = self._executor.threads or 1
        return tuple(self._taken.take(f'thread_{index}') for index in range(number))

    def _drafts(self) -> Iterable[tuple[Callback, int]]:
        """Give callbacks without their final names, with the number of their group."""
        for node in self._nodes:
            for called in node.called:
                yield self._called_callback(called, node), called.group
        for entity in self._recording.entities:
            if entity.node in self._node_names:
                yield self._callback(entity), entity.group
                if entity.execute is not None:
                    yield self._execute_callback(entity, entity.execute), _GROUPLESS
        for task in self._recording.tasks:
            if task.executor == self._executor.number:
                yield self._task_callback(task), _GROUPLESS

    def _serving_order(self, draft: tuple[Callback, int]) -> tuple[bool, int, int]:
        callback, _ = draft
        names = list(self._node_names.values())
        node = names.index(callback.node) if callback.node in names else len(names)
        kind = callback.entity
        assert kind is not None
        return callback.groupless, node, _ORDER.index(kind)

    def _callback(self, entity: RecordedEntity) -> Callback:
        kind = EntityKind(entity.kind)
        function = entity.function
        assert entity.node is not None
        unresolved = None
        if function is None and kind in _HAVE_FUNCTION and entity.library is None:
            unresolved = Unknown('it was gone before its callback could be read', entity.created)
        return Callback(
            name=self._label(entity, kind),
            type=kind.published_type,
            group='',
            entity=kind,
            node=self._node_names[entity.node],
            function=function.name if function else None,
            key=_key(entity, kind),
            period_s=entity.period_s if kind is EntityKind.TIMER else None,
            count=entity.made,
            when=_when(entity),
            conditional=entity.in_callback,
            coroutine=function.coroutine if function else False,
            library=entity.library,
            builtin=entity.builtin,
            destroyed=entity.destroyed,
            unresolved=unresolved,
            measured=entity.measured if entity.measured.count or entity.measured.refused else None,
            source=entity.created,
            defined=function.defined if function else None,
        )

    def _called_callback(self, called: RecordedCalled, node: RecordedNode) -> Callback:
        kind = EntityKind(called.kind)
        return Callback(
            name=_last_part(called.function),
            type=kind.published_type,
            group='',
            entity=kind,
            node=self._node_names[node.number],
            function=called.function.name,
            coroutine=called.function.coroutine,
            defined=called.function.defined,
        )

    def _execute_callback(self, entity: RecordedEntity, function: Function) -> Callback:
        return replace(
            self._groupless(EntityKind.ACTION_EXECUTE, function, entity.node),
            key=_key(entity, EntityKind.ACTION_SERVER),
            source=entity.created,
        )

    def _task_callback(self, task: RecordedTask) -> Callback:
        kind = EntityKind(task.kind)
        node = task.node
        if node is None and len(self._nodes) == 1:
            node = self._nodes[0].number
        return self._groupless(kind, task.function, node)

    def _groupless(self, kind: EntityKind, function: Function, node: int | None) -> Callback:
        return Callback(
            name=_last_part(function),
            type=kind.published_type,
            group='',
            entity=kind,
            node=self._node_names.get(node) if node is not None else None,
            function=function.name,
            coroutine=function.coroutine,
            groupless=True,
            defined=function.defined,
        )

    def _label(self, entity: RecordedEntity, kind: EntityKind) -> str:
        end = _LABEL_ENDS.get(kind)
        if end is not None and (entity.builtin or kind is not EntityKind.QOS_EVENT):
            return f'{mend(entity.key)}_{end}' if entity.key else end
        if entity.function is not None and not entity.library:
            return _last_part(entity.function)
        is_rate = entity.library == 'rclpy.create_rate'
        return 'rate_timer' if is_rate else mend(entity.key or kind.value)

    def _wanted(self, draft: Callback) -> Wanted:
        several = len(self._nodes) > 1 and isinstance(draft.node, str)
        key = mend(draft.key) if isinstance(draft.key, str) else None
        return Wanted(draft.name, key, str(draft.node) if several else None)

    def _groups(
        self, drafts: Sequence[tuple[Callback, int]], labels: Sequence[str]
    ) -> list[CallbackGroup]:
        """Give the groups in use, in order of creation; the one for group-less work last."""
        first_label: dict[int, str] = {}
        for (_, number), label in zip(drafts, labels, strict=True):
            first_label.setdefault(number, label)
        known = {group.number: group for group in self._recording.groups}
        groups = []
        for number in sorted(first_label, key=lambda n: (n == _GROUPLESS, n)):
            group = known.get(number)
            name = self._taken.take(self._group_label(group, first_label[number]))
            self._group_names[number] = name
            groups.append(self._group(group, name))
        return groups

    def _group_label(self, group: RecordedGroup | None, first_member: str) -> str:
        if group is None:
            return 'no_group'
        if group.default and group.node in self._node_names:
            return f'{self._node_names[group.node]}_default'
        return 'rate_group' if group.rate else f'{first_member}_group'

    def _group(self, group: RecordedGroup | None, name: str) -> CallbackGroup:
        if group is None:
            return CallbackGroup(name=name, type=GroupType.REENTRANT, groupless=True)
        own = group.kind == 'own'
        return CallbackGroup(
            name=name,
            type=GroupType.REENTRANT if group.kind == 'reentrant' else GroupType.EXCLUSIVE,
            default=group.default,
            node=self._node_names.get(group.node) if group.node is not None else None,
            library='rclpy.create_rate' if group.rate else None,
            cls=group.cls if own else None,
            unresolved=Unknown(f'own group class {group.cls}', group.created) if own else None,
            source=None if group.default or group.rate else group.created,
        )

    def _executor_value(self, threads: tuple[str, ...]) -> Executor:
        seen = self._executor
        return Executor(
            name=self._taken.take('executor'),
            threads=threads,
            kind=seen.cls,
            threads_source=DEFAULT_COUNT if seen.default_threads else None,
            in_thread=bool(seen.in_thread),
            spun=seen.spun,
            unresolved=self._why_unresolved(),
            source=seen.created,
        )

    def _why_unresolved(self) -> Unknown | None:
        seen = self._executor
        if seen.own_class:
            return Unknown(f'own executor class {seen.cls}', seen.created)
        if seen.threads is None:
            return Unknown('thread count could not be read', seen.created)
        return None


# No object has this number; they are counted from 1.
_GROUPLESS = 0
_HAVE_FUNCTION = (EntityKind.TIMER, EntityKind.SUBSCRIPTION, EntityKind.SERVICE)


def _node_names(nodes: Sequence[RecordedNode]) -> dict[int, str]:
    names: dict[int, str] = {}
    for node in nodes:
        names[node.number] = mend(node.name or 'node', tuple(names.values()))
    return names


def _key(entity: RecordedEntity, kind: EntityKind) -> str | Unknown | None:
    if kind is EntityKind.ACTION_SERVER and entity.key is None:
        return Unknown('rclpy does not keep the name of an action server', entity.created)
    return entity.key if kind.key_name else None


def _when(entity: RecordedEntity) -> When:
    if entity.in_configure:
        return When.CONFIGURE
    if entity.in_callback:
        return When.CALLBACK
    return When.LATER if entity.late else When.START


def _last_part(function: Function) -> str:
    return function.name.rpartition('.')[2].strip('<>')


def _sources(callbacks: Iterable[Callback]) -> tuple[str, ...]:
    places: list[Place | None] = [c.source for c in callbacks if not c.builtin]
    return tuple(dict.fromkeys(place.file for place in places if place))
