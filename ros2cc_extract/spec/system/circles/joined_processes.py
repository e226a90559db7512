"""
Processes that wait for each other in a circle, as one unit.

A unit's verdict rests on the assumption that what is outside of it answers. Where a process needs
another one, and that one needs the first, neither verdict can bear the other: these processes, and
no others, are put into one network. The graph says what they call each other; parts of
one name have that of their process before it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.errors import SpecFormatError
from ros2cc_extract.identity_memo import once
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.client_server_pairs import asked_by, reachable, servers_of
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.joined_executors import KINDS, Joined, joined, why_not_joined
from ros2cc_extract.spec.model import (
    Activity,
    Callback,
    EntityKind,
    Spec,
)
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.circles.action_phases import needs_itself, with_phases
from ros2cc_extract.spec.system.circles.messages import (
    ended_by_messages,
    senders_in,
    with_messages,
)
from ros2cc_extract.spec.system.circles.part_names import PartNames, parts_of, renamed_parts
from ros2cc_extract.spec.system.circles.sure_answers import without_sure_waits
from ros2cc_extract.spec.system.circles.transitions import several_wait
from ros2cc_extract.spec.system.model import Process, System

_SERVERS = (EndpointKind.SERVICE, EndpointKind.ACTION_SERVER)
_BETWEEN = '; they are in processes that run at the same time'
_OFFERS = {
    EntityKind.SERVICE: 'service',
    EntityKind.ACTION_SERVER: 'action',
    EntityKind.LIFECYCLE_SERVICE: 'service',
}


@dataclass(frozen=True, kw_only=True)
class Circles:
    """
    The circles of a system.

    :param joined: those that can be decided together.
    :param open: why others cannot, with the processes.
    """

    joined: tuple[Joined, ...]
    open: tuple[tuple[tuple[Process, ...], Unknown], ...]


@once
def circles_of(system: System) -> Circles:
    """Find the processes that wait for each other, and put each circle into one unit."""
    found: list[Joined] = []
    left: list[tuple[tuple[Process, ...], Unknown]] = []
    senders = senders_in(system)
    for circle in circles_in(system):
        why = next(filter(None, map(_why_not, circle)), None)
        names = {each.name for each in circle}
        sent = {topic for topic, by in senders.items() if by <= names}
        one = _joined(circle, sent) if why is None else why
        if isinstance(one, Joined):
            found.append(one)
        elif one is not None:
            left.append((tuple(circle), one))
    return Circles(joined=tuple(found), open=tuple(left))


def circles_in(system: System) -> Iterator[list[Process]]:
    """
    Sets of several processes, each of which needs each other one.

    A message is needed of a circle only if no other process sends on the topic.
    """
    offered = {
        (each.what, each.name): {
            end.process.name for kind in _SERVERS for end in each.of_kind(kind)
        }
        for each in system.connections
    }
    senders = senders_in(system)
    needed = {
        process.name: {(wait.what, wait.name) for wait in circle_waits(process)}
        for process in system.processes
    }
    while True:
        known = offered | {('topic', topic): set(by) for topic, by in senders.items()}
        circles = list(_circles(system.processes, needed, known))
        beside = {
            topic
            for circle in circles
            for topic, by in senders.items()
            if any(('topic', topic) in needed[each.name] for each in circle)
            and not by <= {each.name for each in circle}
        }
        if not beside:
            yield from circles
            return
        senders = {topic: by for topic, by in senders.items() if topic not in beside}


def _circles(
    processes: Sequence[Process],
    needed: Mapping[str, Collection[object]],
    offered: Mapping[tuple[str, str], Collection[str]],
) -> Iterator[list[Process]]:
    ahead = {
        name: {other for key, by in offered.items() if key in keys for other in by}
        for name, keys in needed.items()
    }
    reached = {name: reachable(name, ahead) for name in ahead}
    done: set[str] = set()
    for process in processes:
        mine = [
            other
            for other in processes
            if other.name in reached[process.name] and process.name in reached[other.name]
        ]
        if len(mine) > 1 and process.name not in done:
            done |= {each.name for each in mine}
            yield mine


@dataclass(frozen=True)
class ServiceWait:
    """
    A wait without a time-out for the answer of a service or an action, or for a message.

    :param client: what takes it.
    :param name: resolved.
    """

    unit: Spec
    doer: Callback | Activity
    block: Blocking
    client: Callback
    what: str
    name: str | Unknown


def service_waits(process: Process) -> Iterator[ServiceWait]:
    """The waits of a process for answers."""
    parts = parts_of(process)
    names = PartNames(process, parts)
    everybody = [callback for part in parts for callback in part.callbacks]
    for unit, doer, block in _waits_of(process, parts):
        for client in asked_by(block, everybody):
            key = names.key(client)
            what = 'service' if client.entity is EntityKind.CLIENT else 'action'
            if key is not None:
                yield ServiceWait(unit, doer, block, client, what, key)


def _waits_of(
    process: Process, parts: Sequence[Spec]
) -> Iterator[tuple[Spec, Callback | Activity, Blocking]]:
    """Each wait of the parts of a process, with the unit that the part is of."""
    for unit, part in zip(process.working_units, parts, strict=True):
        doers: tuple[Callback | Activity, ...] = (*part.callbacks, *part.activities)
        yield from ((unit, doer, block) for doer in doers for block in doer.blocking)


def units_by_offer(system: System) -> dict[tuple[str, str], list[Spec]]:
    """The units that offer each service and action, by kind and name."""
    found: dict[tuple[str, str], list[Spec]] = defaultdict(list)
    for process in system.processes:
        for unit in process.units:
            names = PartNames(process, [unit])
            for callback in unit.callbacks:
                what = _OFFERS.get(callback.entity) if callback.entity is not None else None
                key = names.key(callback) if what is not None else None
                if what is not None and isinstance(key, str):
                    found[what, key].append(unit)
    return found


def message_waits(process: Process) -> Iterator[ServiceWait]:
    """The waits of a process that messages alone end."""
    parts = parts_of(process)
    names = PartNames(process, parts)
    everybody = {each.name: each for part in parts for each in part.callbacks}
    for unit, doer, block in _waits_of(process, parts):
        for heard in ended_by_messages(block, everybody):
            key = names.key(heard)
            if key is not None:
                yield ServiceWait(unit, doer, block, heard, 'topic', key)


def circle_waits(process: Process) -> Iterator[ServiceWait]:
    """The waits that other processes end, by which a circle may go."""
    yield from service_waits(process)
    yield from message_waits(process)


def _why_not(process: Process) -> Unknown | None:
    """Why the executors of a process cannot be put beside others."""
    if len(process.working_units) > 1 and parts_of(process) is process.working_units:
        what = f'what the executors of {process.name} do to each other is not known'
        return Unknown(what, process.launched.source)
    if process.launched.conditional is not None:
        doubt = process.launched.conditional
        return Unknown(f'{process.name} may not be started: {doubt.reason}', doubt.at)
    if not process.launched.is_beside_others:
        later = process.launched.later
        return Unknown(f'{process.name} is begun by the {later}', process.launched.source)
    for unit in process.working_units:
        if several_wait(unit):
            what = f'several transitions of {process.name} wait, and which is asked for is open'
            return Unknown(what, process.launched.source)
        executor = unit.executor
        is_known = isinstance(executor.kind, str) and executor.kind in KINDS
        is_spun = executor.spun is not None and executor.alternative is None
        if not is_known or not is_spun or executor.unresolved is not None:
            why = executor.unresolved
            why = why or (executor.kind if isinstance(executor.kind, Unknown) else None)
            return why or Unknown('its executor is not followed', executor.source)
    return None


def _joined(circle: Sequence[Process], sent: Collection[str]) -> Joined | Unknown | None:
    """
    One unit of all; or why it cannot be made; ``None`` if no executor needs itself by them.

    :param sent: topics on which only these processes send.
    """
    parts = with_messages(with_phases(renamed_parts(circle)), sent)
    try:
        whole = whole_of(parts)
    except SpecFormatError as error:
        return Unknown(str(error))
    goal = needs_itself(whole)
    if goal is not None:
        return Unknown(f'the {goal} may need another goal of it')
    why_open = next(_open_answers(whole), None)
    if why_open is not None:
        return why_open
    found = joined(whole, parts)
    if found is None:
        why = why_not_joined(whole, parts)
        return Unknown(why) if why else None
    counts = [len(process.working_units) for process in circle]
    by_process: list[tuple[str, ...]] = []
    at = 0
    for count in counts:
        mine = found.parts[at : at + count]
        by_process.append(tuple(name for part in mine for name in part))
        at += count
    return without_sure_waits(replace(found, parts=tuple(by_process), between=_BETWEEN))


def _open_answers(whole: Spec) -> Iterator[Unknown]:
    """Waits for answers whose server the model of all does not have."""
    doers: tuple[Callback | Activity, ...] = (*whole.callbacks, *whole.activities)
    for block in (block for doer in doers for block in doer.blocking):
        clients = asked_by(block, whole.callbacks)
        servers = {each.name: servers_of(each, whole.callbacks) for each in clients}
        asked = [name for name, known in servers.items() if known]
        if len(clients) > 1 and asked:
            yield Unknown(f'{block.call} ends by several answers', block.source)
        if any(len(known) > 1 for known in servers.values()):
            yield Unknown(f'several processes offer what {block.call} waits for', block.source)


def whole_of(parts: Sequence[Spec]) -> Spec:
    """All parts side by side, as if one executor served them."""
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
