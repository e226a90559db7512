"""
The parts of one process under the names that they have in the system.

Where several processes are put into one unit, parts of one name have that of their process before
it; topics, services and actions are called as in the graph.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.client_server_pairs import is_done_callback
from ros2cc_extract.spec.effects import OUTSIDE, RE_ENTRANT, TIME, Act, Blocking, Waker
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.model import (
    Activity,
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    Spec,
)
from ros2cc_extract.spec.node_graph import CHANGE_STATE, EndpointKind
from ros2cc_extract.spec.system.circles.transitions import as_services
from ros2cc_extract.spec.system.model import Process, SystemEndpoint, SystemNode

_NOBODY = (OUTSIDE, TIME)
_CLIENTS = (EndpointKind.CLIENT, EndpointKind.ACTION_CLIENT)


def parts_of(process: Process) -> tuple[Spec, ...]:
    """
    The units of a process; where it has several, with the names that they have together.

    Only those say what one executor wakes, locks or asks of another one of its process.
    """
    whole, units = process.whole, process.working_units
    nodes = [node for unit in units for node in unit.nodes]
    if whole is None or len(whole.nodes) != len(nodes):
        return units
    if not all(isinstance(each.node, str) for each in whole.callbacks):
        return units
    found: list[Spec] = []
    at = 0
    for number, unit in enumerate(units):
        mine = whole.nodes[at : at + len(unit.nodes)]
        at += len(unit.nodes)
        callbacks = tuple(each for each in whole.callbacks if each.node in mine)
        used = {each.group for each in callbacks}
        found.append(
            replace(
                unit,
                callbacks=callbacks,
                groups=tuple(each for each in whole.groups if each.name in used),
                activities=whole.activities if number == 0 else (),
                nodes=mine,
                set_up=whole.set_up,
            )
        )
    return tuple(found)


def renamed_parts(circle: Sequence[Process]) -> list[Spec]:
    """The parts of several processes, none of which share a name that means two things."""
    parts = {process.name: parts_of(process) for process in circle}
    counted = Counter(name for mine in parts.values() for name in _names_of(mine))
    shared = frozenset(name for name, number in counted.items() if number > 1)
    found: list[Spec] = []
    for process in circle:
        prefix = f'{mend(process.name.replace(".", "_"))}_'
        names = PartNames(process, parts[process.name], prefix, shared)
        found += [as_services(_renamed(unit, names)) for unit in parts[process.name]]
    return found


class PartNames:
    """The names that the parts of one process have in the system."""

    def __init__(
        self,
        process: Process,
        units: Sequence[Spec],
        prefix: str = '',
        shared: frozenset[str] = frozenset(),
    ) -> None:
        self._nodes: dict[str, SystemNode] = {
            node.own_name: node for node in process.nodes if isinstance(node.own_name, str)
        }
        self._prefix = prefix
        self._shared = shared
        self._own = {
            *(each.name for unit in units for each in unit.callbacks),
            *(each.name for unit in units for each in unit.activities),
        }

    def name(self, name: str) -> str:
        """A name of the unit, with that of its process before it where others have it too."""
        is_shared = name.removesuffix(RE_ENTRANT) in self._shared
        return f'{self._prefix}{name}' if is_shared else name

    def doer(self, name: str) -> str:
        """A callback or activity; time and what is outside have no process."""
        return name if name in _NOBODY else self.name(name)

    def on(self, on: str | Unknown | None) -> str | Unknown | None:
        """What is waited for, where that is a part of the unit."""
        return self.name(on) if isinstance(on, str) and on in self._own else on

    def key(self, callback: Callback) -> str | Unknown | None:
        """The resolved name of a topic, service or action; a done-callback has its client's."""
        is_transition = callback.entity is EntityKind.LIFECYCLE_SERVICE
        key = CHANGE_STATE if is_transition else callback.key
        node = self._nodes.get(callback.node) if isinstance(callback.node, str) else None
        if not isinstance(key, str):
            return key
        if is_done_callback(callback):
            return self._of_name(key, node, _CLIENTS)
        if node is None:
            return Unknown('its node is not known in the system', callback.source)
        for endpoint in node.endpoints:
            if endpoint.source == callback.source and endpoint.written == key:
                return endpoint.name
        return self._of_name(key, node)

    def topic(self, written: str | Unknown, of_node: str | Unknown | None) -> str | Unknown:
        """The name of a topic that the code of a node publishes, by whichever node has it."""
        if not isinstance(written, str):
            return written
        node = self._nodes.get(of_node) if isinstance(of_node, str) else None
        for nodes in ([node] if node else [], self._nodes.values()):
            ends = [end for each in nodes for end in each.endpoints if _is_sent(end, written)]
            named = {end.name for end in ends}
            if len(named) == 1:
                return named.pop()
            if named:
                break
        return Unknown('its name in the system is not known')

    def _of_name(
        self,
        key: str,
        node: SystemNode | None,
        kinds: Container[EndpointKind] = tuple(EndpointKind),
    ) -> str | Unknown:
        """How endpoints of these kinds that are written so are called, else by rules alone."""
        ends = node.endpoints if node is not None else ()
        named = {end.name for end in ends if end.written == key and end.kind in kinds}
        if len(named) == 1:
            return named.pop()
        if node is not None and node.naming is not None:
            return node.naming.resolved(key, is_service=True)
        return Unknown('its name in the system is not known')


def _is_sent(end: SystemEndpoint, written: str) -> bool:
    is_same = isinstance(end.written, str) and end.written.strip('/') == written.strip('/')
    return end.kind is EndpointKind.PUBLISHER and is_same


def _names_of(units: Iterable[Spec]) -> set[str]:
    return {name.removesuffix(RE_ENTRANT) for unit in units for name in _names_in(unit)}


def _names_in(unit: Spec) -> Iterator[str]:
    yield from unit.nodes
    yield unit.name
    yield from (each.name for each in unit.callbacks)
    yield from (each.name for each in unit.groups)
    yield from (each.name for each in unit.activities)
    doers: tuple[Callback | Activity, ...] = (*unit.callbacks, *unit.activities)
    for doer in doers:
        yield from (act.name for act in doer.locks if isinstance(act.name, str))
        for block in doer.blocking:
            yield from (block.resource, *block.held) if block.resource else block.held


def _renamed(unit: Spec, names: PartNames) -> Spec:
    return replace(
        unit,
        name=names.name(unit.name),
        nodes=tuple(names.name(node) for node in unit.nodes),
        callbacks=tuple(_callback(each, names) for each in unit.callbacks),
        groups=tuple(_group(each, names) for each in unit.groups),
        activities=tuple(_activity(each, names) for each in unit.activities),
        executor=_executor(unit.executor, names),
        unresolved=(),
    )


def _callback(callback: Callback, names: PartNames) -> Callback:
    return replace(
        callback,
        name=names.name(callback.name),
        group=names.name(callback.group),
        node=names.name(callback.node) if isinstance(callback.node, str) else callback.node,
        key=names.key(callback),
        alternative=None if callback.alternative is None else names.name(callback.alternative),
        blocking=tuple(_blocking(each, names, callback.node) for each in callback.blocking),
        publishes=_publishes(callback, names),
        locks=tuple(_lock(each, names) for each in callback.locks),
        reads=(),
        writes=(),
        pieces=(),
    )


def _activity(activity: Activity, names: PartNames) -> Activity:
    return replace(
        activity,
        name=names.name(activity.name),
        node=names.name(activity.node) if isinstance(activity.node, str) else activity.node,
        starts=tuple(_waker(each, names) for each in activity.starts),
        blocking=tuple(_blocking(each, names, activity.node) for each in activity.blocking),
        publishes=_publishes(activity, names),
        locks=tuple(_lock(each, names) for each in activity.locks),
        reads=(),
        writes=(),
        pieces=(),
    )


def _group(group: CallbackGroup, names: PartNames) -> CallbackGroup:
    node = names.name(group.node) if group.node is not None else None
    return replace(group, name=names.name(group.name), node=node)


def _executor(executor: Executor, names: PartNames) -> Executor:
    threads = tuple(names.name(thread) for thread in executor.threads)
    return replace(executor, name=names.name(executor.name), threads=threads)


def _publishes(doer: Callback | Activity, names: PartNames) -> tuple[Act, ...]:
    return tuple(replace(act, name=names.topic(act.name, doer.node)) for act in doer.publishes)


def _blocking(block: Blocking, names: PartNames, node: str | Unknown | None) -> Blocking:
    asked = (names.topic(each, node) for each in (block.answer_to or '').split(', ') if each)
    return replace(
        block,
        answer_to=', '.join(each for each in asked if isinstance(each, str)) or None,
        on=names.on(block.on),
        held=tuple(names.name(lock) for lock in block.held),
        resource=None if block.resource is None else names.name(block.resource),
        wakers=tuple(_waker(each, names) for each in block.wakers),
    )


def _waker(waker: Waker, names: PartNames) -> Waker:
    held = tuple(names.name(lock) for lock in waker.held)
    return replace(waker, by=names.doer(waker.by), held=held)


def _lock(act: Act, names: PartNames) -> Act:
    name = names.name(act.name) if isinstance(act.name, str) else act.name
    return replace(act, name=name, held=tuple(names.name(lock) for lock in act.held))
