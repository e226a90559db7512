"""
Services and actions that are there for certain once the system has started.

Alone, a callback that waits in ``wait_for_service`` waits for a node outside. In a system whose
processes offer it in their set-up, which comes to its end, that wait is over in some time.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Activity, Callback, EntityKind, Spec
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.circles.part_names import PartNames
from ros2cc_extract.spec.system.model import End, Process, System
from ros2cc_extract.spec.system.start_up import stuck_waits

_KINDS = {
    EntityKind.CLIENT: EndpointKind.SERVICE,
    EntityKind.ACTION_CLIENT: EndpointKind.ACTION_SERVER,
}
_UNTIL_THERE = ('wait_for_service', 'wait_for_server')
_Offers = Mapping[tuple[EndpointKind, str], str]


def with_offers(system: System) -> System:
    """The system with each wait for a server as one that ends, if there is a server."""
    offers = dict(_offers(system))
    return replace(system, processes=tuple(_process(each, offers) for each in system.processes))


def _offers(system: System) -> Iterator[tuple[tuple[EndpointKind, str], str]]:
    stuck = {wait.process.name for wait in stuck_waits(system)}
    for end in system.ends:
        kind, name = end.endpoint.kind, end.endpoint.name
        if kind in _KINDS.values() and isinstance(name, str) and _is_certain(end, stuck):
            yield (kind, name), end.process.name


def _is_certain(end: End, stuck: set[str]) -> bool:
    """Whether its process is started in any case, makes it, and gets beyond its set-up."""
    launched = end.process.launched
    is_started = launched.conditional is None and launched.is_beside_others
    return is_started and not end.endpoint.conditional and end.process.name not in stuck


def _process(process: Process, offers: _Offers) -> Process:
    whole = process.whole
    return replace(
        process,
        units=tuple(_unit(each, process, offers) for each in process.units),
        whole=None if whole is None else _unit(whole, process, offers),
    )


def _unit(unit: Spec, process: Process, offers: _Offers) -> Spec:
    if not any(_waits_until_there(b) for each in _doers(unit) for b in each.blocking):
        return unit
    names = PartNames(process, [unit])
    by = {
        client.name: offers[kind, key]
        for client in unit.callbacks
        if (kind := _KINDS.get(client.entity) if client.entity else None) is not None
        and isinstance(key := names.key(client), str)
        and (kind, key) in offers
    }

    def settled(blocks: tuple[Blocking, ...]) -> tuple[Blocking, ...]:
        return tuple(_settled(block, by) for block in blocks)

    return replace(
        unit,
        callbacks=tuple(replace(c, blocking=settled(c.blocking)) for c in unit.callbacks),
        activities=tuple(replace(a, blocking=settled(a.blocking)) for a in unit.activities),
    )


def _doers(unit: Spec) -> tuple[Callback | Activity, ...]:
    return (*unit.callbacks, *unit.activities)


def _waits_until_there(block: Blocking) -> bool:
    return block.call in _UNTIL_THERE and block.seconds is None


def _settled(block: Blocking, by: Mapping[str, str]) -> Blocking:
    on = block.on if isinstance(block.on, str) else ''
    if not _waits_until_there(block) or on not in by:
        return block
    return replace(block, seconds=Unknown(f'until {by[on]} has started', block.source))
