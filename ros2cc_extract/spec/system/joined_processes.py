"""
Processes that wait for each other in a circle, as one unit.

A unit's verdict rests on the assumption that what is outside of it answers. Where a process needs
another one, and that one needs the first, neither verdict can bear the other: these processes, and
no others, are put into one network. What they call each other is told by the graph; parts of
one name have that of their process before it.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.errors import SpecFormatError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import OUTSIDE, TIME, Act, Blocking, Waker
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.joined_executors import KINDS, Joined, joined, why_not_joined
from ros2cc_extract.spec.model import (
    Activity,
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    Spec,
)
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.action_phases import needs_itself, with_phases
from ros2cc_extract.spec.system.model import Process, System, SystemNode

_CLIENTS = (EntityKind.CLIENT, EntityKind.ACTION_CLIENT)
_SERVERS = (EndpointKind.SERVICE, EndpointKind.ACTION_SERVER)
_BETWEEN = '; they are in processes that run at the same time'
_NOBODY = (OUTSIDE, TIME)
_OFFERS = {EntityKind.SERVICE: 'service', EntityKind.ACTION_SERVER: 'action'}


@dataclass(frozen=True, kw_only=True)
class Circles:
    """
    The circles of a system.

    :param joined: those that can be decided together.
    :param open: why others cannot, with the processes.
    """

    joined: tuple[Joined, ...]
    open: tuple[tuple[tuple[Process, ...], Unknown], ...]


def circles_of(system: System) -> Circles:
    """Find the processes that wait for each other, and put each circle into one unit."""
    found: list[Joined] = []
    left: list[tuple[tuple[Process, ...], Unknown]] = []
    for circle in circles_in(system):
        why = next(filter(None, map(_why_not, circle)), None)
        one = _joined(circle) if why is None else why
        if isinstance(one, Joined):
            found.append(one)
        elif one is not None:
            left.append((tuple(circle), one))
    return Circles(joined=tuple(found), open=tuple(left))


def circles_in(system: System) -> Iterator[list[Process]]:
    """Sets of several processes, each of which needs each other one."""
    offered = {
        (each.what, each.name): {
            end.process.name for kind in _SERVERS for end in each.of_kind(kind)
        }
        for each in system.connections
    }
    ahead = {
        process.name: {
            other for key in _needed(process) for other in offered.get(key, ()) if other
        }
        for process in system.processes
    }
    reached = {name: _reached(name, ahead) for name in ahead}
    told: set[str] = set()
    for process in system.processes:
        mine = [
            other
            for other in system.processes
            if other.name in reached[process.name] and process.name in reached[other.name]
        ]
        if len(mine) > 1 and process.name not in told:
            told |= {each.name for each in mine}
            yield mine


def _reached(name: str, ahead: Mapping[str, set[str]]) -> set[str]:
    found: set[str] = set()
    left = [name]
    while left:
        new = ahead.get(left.pop(), set()) - found
        found |= new
        left += new
    return found


@dataclass(frozen=True)
class ServiceWait:
    """
    A wait without a time-out for the answer of a service or an action.

    :param name: resolved.
    """

    unit: Spec
    doer: Callback | Activity
    block: Blocking
    what: str
    name: str | Unknown


def service_waits(process: Process) -> Iterator[ServiceWait]:
    """The waits of a process for answers."""
    for unit in process.units:
        names = _Names(process, unit)
        clients = {each.name: each for each in unit.callbacks if each.entity in _CLIENTS}
        doers: tuple[Callback | Activity, ...] = (*unit.callbacks, *unit.activities)
        for doer in doers:
            for block in doer.blocking:
                client = clients.get(block.on) if isinstance(block.on, str) else None
                key = names.key(client) if client is not None else None
                if client is not None and block.seconds is None and key is not None:
                    what = 'service' if client.entity is EntityKind.CLIENT else 'action'
                    yield ServiceWait(unit, doer, block, what, key)


def units_by_offer(system: System) -> dict[tuple[str, str], list[Spec]]:
    """The units that offer each service and action, by kind and name."""
    found: dict[tuple[str, str], list[Spec]] = defaultdict(list)
    for process in system.processes:
        for unit in process.units:
            names = _Names(process, unit)
            for callback in unit.callbacks:
                what = _OFFERS.get(callback.entity) if callback.entity is not None else None
                key = names.key(callback) if what is not None else None
                if what is not None and isinstance(key, str):
                    found[what, key].append(unit)
    return found


def _needed(process: Process) -> Iterator[tuple[str, str]]:
    """Services and actions whose answer something in the process waits for."""
    for wait in service_waits(process):
        if isinstance(wait.name, str):
            yield wait.what, wait.name


def _why_not(process: Process) -> Unknown | None:
    """Why the executors of a process cannot be put beside others."""
    if process.launched.conditional is not None:
        doubt = process.launched.conditional
        return Unknown(f'{process.name} may not be started: {doubt.reason}', doubt.at)
    if not process.launched.is_beside_others:
        later = process.launched.later
        return Unknown(f'{process.name} is begun by the {later}', process.launched.source)
    for unit in process.units:
        executor = unit.executor
        is_known = isinstance(executor.kind, str) and executor.kind in KINDS
        is_spun = executor.spun is not None and executor.alternative is None
        if not is_known or not is_spun or executor.unresolved is not None:
            why = executor.unresolved
            why = why or (executor.kind if isinstance(executor.kind, Unknown) else None)
            return why or Unknown('its executor is not followed', executor.source)
    return None


def _joined(circle: Sequence[Process]) -> Joined | Unknown | None:
    """One unit of all; why there is none, or ``None`` where no executor needs itself by them."""
    shared = _shared_names([unit for process in circle for unit in process.units])
    parts = [
        _renamed(process, unit, _prefix(process, number), shared)
        for process in circle
        for number, unit in enumerate(process.units)
    ]
    parts = with_phases(parts)
    try:
        whole = _whole(parts)
    except SpecFormatError as error:
        return Unknown(str(error))
    goal = needs_itself(whole)
    if goal is not None:
        return Unknown(f'the {goal} may need another goal of it')
    found = joined(whole, parts)
    if found is None:
        why = why_not_joined(whole, parts)
        return Unknown(why) if why else None
    counts = [len(process.units) for process in circle]
    by_process: list[tuple[str, ...]] = []
    at = 0
    for count in counts:
        mine = found.parts[at : at + count]
        by_process.append(tuple(name for part in mine for name in part))
        at += count
    return replace(found, parts=tuple(by_process), between=_BETWEEN)


def _whole(parts: Sequence[Spec]) -> Spec:
    first = parts[0]
    return Spec(
        name='_and_'.join(dict.fromkeys(part.nodes[0] for part in parts if part.nodes))[:80],
        callbacks=tuple(each for part in parts for each in part.callbacks),
        groups=tuple(each for part in parts for each in part.groups),
        executor=replace(first.executor, name='executor_of_system', threads=('thread_of_system',)),
        activities=tuple(each for part in parts for each in part.activities),
        origin=first.origin,
        nodes=tuple(node for part in parts for node in part.nodes),
        sources=tuple(dict.fromkeys(file for part in parts for file in part.sources)),
        rclpy=first.rclpy,
    )


class _Names:
    """The names that the parts of one unit have in the system."""

    def __init__(
        self,
        process: Process,
        unit: Spec,
        prefix: str = '',
        shared: frozenset[str] = frozenset(),
    ) -> None:
        self._nodes: dict[str, SystemNode] = {
            node.own_name: node for node in process.nodes if isinstance(node.own_name, str)
        }
        self._prefix = prefix
        self._shared = shared
        self._own = {
            *(each.name for each in unit.callbacks),
            *(each.name for each in unit.activities),
        }

    def name(self, name: str) -> str:
        """A name of the unit, with that of its process before it where others have it too."""
        return f'{self._prefix}{name}' if name in self._shared else name

    def doer(self, name: str) -> str:
        """A callback or activity; time and what is outside have no process."""
        return name if name in _NOBODY else self.name(name)

    def on(self, on: str | Unknown | None) -> str | Unknown | None:
        """What is waited for, where that is a part of the unit."""
        return self.name(on) if isinstance(on, str) and on in self._own else on

    def key(self, callback: Callback) -> str | Unknown | None:
        """The resolved name of a topic, service or action; a done-callback names its client."""
        key = callback.key
        node = self._nodes.get(callback.node) if isinstance(callback.node, str) else None
        if not isinstance(key, str):
            return key
        if callback.entity is EntityKind.DONE_CALLBACK:
            return self.name(key) if key in self._own else self._of_name(key, node)
        if node is None:
            return Unknown('its node is not known in the system', callback.source)
        for endpoint in node.endpoints:
            if endpoint.source == callback.source and endpoint.written == key:
                return endpoint.name
        return self._of_name(key, node)

    def _of_name(self, key: str, node: SystemNode | None) -> str | Unknown:
        """A name by the rules alone, as of what rclpy itself makes."""
        ends = node.endpoints if node is not None else ()
        named = {end.name for end in ends if end.written == key}
        if len(named) == 1:
            return named.pop()
        if node is not None and node.naming is not None:
            return node.naming.resolved(key, is_service=True)
        return Unknown('its name in the system is not known')


def _prefix(process: Process, number: int) -> str:
    label = mend(process.name.replace('.', '_'))
    return f'{label}_' if len(process.units) == 1 else f'{label}_{number}_'


def _shared_names(units: Sequence[Spec]) -> frozenset[str]:
    """What parts of several units are called; the others keep their names."""
    counted = Counter(name for unit in units for name in set(_names_in(unit)))
    return frozenset(name for name, number in counted.items() if number > 1)


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


def _renamed(process: Process, unit: Spec, prefix: str, shared: frozenset[str]) -> Spec:
    names = _Names(process, unit, prefix, shared)
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


def _callback(callback: Callback, names: _Names) -> Callback:
    return replace(
        callback,
        name=names.name(callback.name),
        group=names.name(callback.group),
        node=names.name(callback.node) if isinstance(callback.node, str) else callback.node,
        key=names.key(callback),
        alternative=None if callback.alternative is None else names.name(callback.alternative),
        blocking=tuple(_blocking(each, names) for each in callback.blocking),
        locks=tuple(_lock(each, names) for each in callback.locks),
        reads=(),
        writes=(),
        pieces=(),
    )


def _activity(activity: Activity, names: _Names) -> Activity:
    return replace(
        activity,
        name=names.name(activity.name),
        node=names.name(activity.node) if isinstance(activity.node, str) else activity.node,
        starts=tuple(_waker(each, names) for each in activity.starts),
        blocking=tuple(_blocking(each, names) for each in activity.blocking),
        locks=tuple(_lock(each, names) for each in activity.locks),
        reads=(),
        writes=(),
        pieces=(),
    )


def _group(group: CallbackGroup, names: _Names) -> CallbackGroup:
    node = names.name(group.node) if group.node is not None else None
    return replace(group, name=names.name(group.name), node=node)


def _executor(executor: Executor, names: _Names) -> Executor:
    threads = tuple(names.name(thread) for thread in executor.threads)
    return replace(executor, name=names.name(executor.name), threads=threads)


def _blocking(block: Blocking, names: _Names) -> Blocking:
    return replace(
        block,
        on=names.on(block.on),
        held=tuple(names.name(lock) for lock in block.held),
        resource=None if block.resource is None else names.name(block.resource),
        wakers=tuple(_waker(each, names) for each in block.wakers),
    )


def _waker(waker: Waker, names: _Names) -> Waker:
    held = tuple(names.name(lock) for lock in waker.held)
    return replace(waker, by=names.doer(waker.by), held=held)


def _lock(act: Act, names: _Names) -> Act:
    name = names.name(act.name) if isinstance(act.name, str) else act.name
    return replace(act, name=name, held=tuple(names.name(lock) for lock in act.held))
