"""
In which order the set-ups of a system's processes can come to their end.

A set-up may wait for a service or an action of another process, which is there once the line that
makes it has run, and which answers once its process is spun. Sources: rclpy 7.1.6, ``client.py``,
``action/client.py`` (``wait_for_service``, ``wait_for_server`` ask the graph).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.model import (
    End,
    Process,
    System,
    SystemAwaited,
)

_SERVERS = (EndpointKind.SERVICE, EndpointKind.ACTION_SERVER)
Key = tuple[str, Place]
_Name = tuple[str, str]


@dataclass(frozen=True)
class StartWait:
    """
    A wait of a process in its set-up.

    :param by: the processes that offer what it waits for.
    """

    process: Process
    awaited: SystemAwaited

    by: tuple[str, ...] = ()

    @property
    def key(self) -> Key:
        """What distinguishes it."""
        return self.process.name, self.awaited.source


def stuck_waits(system: System) -> tuple[StartWait, ...]:
    """The waits that no order of starting ends."""
    offers = _offers(system)
    return tuple(_stuck({each.key: each for each in _waits(system, offers)}, offers).values())


def start_circles(system: System) -> Iterator[tuple[StartWait, ...]]:
    """
    Circles of such waits, one for the same processes: each waits for what the next one is before.
    """
    offers = _offers(system)
    stuck = _stuck({each.key: each for each in _waits(system, offers)}, offers)
    known: set[frozenset[str]] = set()
    for wait in stuck.values():
        circle = _circle(wait, stuck, offers)
        names = frozenset(each.process.name for each in circle)
        if circle and names not in known:
            known.add(names)
            yield tuple(circle)


def _waits(system: System, offers: Mapping[_Name, list[End]]) -> Iterator[StartWait]:
    for process in system.processes:
        for awaited in (each for node in process.nodes for each in node.awaits):
            by = (end.process.name for end in _ends(awaited, offers))
            yield StartWait(process, awaited, tuple(dict.fromkeys(by)))


def _ends(awaited: SystemAwaited, offers: Mapping[_Name, list[End]]) -> list[End]:
    name = awaited.name
    return [] if isinstance(name, Unknown) else offers.get((awaited.what, name), [])


def _offers(system: System) -> dict[_Name, list[End]]:
    found: dict[_Name, list[End]] = defaultdict(list)
    for connection in system.connections:
        for kind in _SERVERS:
            found[connection.what, connection.name] += connection.of_kind(kind)
    return {key: ends for key, ends in found.items() if ends}


def _stuck(
    waits: Mapping[Key, StartWait], offers: Mapping[_Name, list[End]]
) -> dict[Key, StartWait]:
    """What is left when every wait that may end has ended; an unknown node may offer the rest."""
    left = dict(waits)
    while True:
        over = [key for key, wait in left.items() if not _needs(wait, left, offers)]
        if not over:
            return left
        for key in over:
            del left[key]


def _needs(
    wait: StartWait, left: Mapping[Key, StartWait], offers: Mapping[_Name, list[End]]
) -> list[StartWait]:
    """The waits that are in the way of every offer of what is awaited; none where one is free."""
    found: list[StartWait] = []
    for end in _ends(wait.awaited, offers):
        mine = [left[key] for key in _before(end, wait, left) if key in left]
        if not mine:
            return []
        found += mine
    return found


def _before(end: End, wait: StartWait, left: Mapping[Key, StartWait]) -> list[Key]:
    """The waits before an offer is there; before it answers, those before its process is spun."""
    name = end.process.name
    if wait.awaited.answers:
        return [key for key in left if key[0] == name]
    return [(name, place) for place in end.endpoint.of.after]


def _circle(
    wait: StartWait, stuck: Mapping[Key, StartWait], offers: Mapping[_Name, list[End]]
) -> list[StartWait]:
    """A way from a wait back to it; empty where it only waits for those of a circle."""
    ways: list[list[StartWait]] = [[wait]]
    seen: set[Key] = set()
    while ways:
        way = ways.pop(0)
        for other in _needs(way[-1], stuck, offers):
            if other.key == wait.key:
                return way
            if other.key not in seen:
                seen.add(other.key)
                ways.append([*way, other])
    return []
