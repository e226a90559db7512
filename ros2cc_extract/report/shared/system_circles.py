"""What of a system a circle of waits goes through."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.circles.joined_processes import circle_waits, circles_in
from ros2cc_extract.spec.system.model import Process, System

Key = tuple[str, str]
"""What a connection is, and its name."""


def in_circles(system: System) -> Mapping[Key, frozenset[str]]:
    """The services, actions and topics of circles of waits, with the processes in these."""
    found: dict[Key, frozenset[str]] = {}
    for circle in circles_in(system):
        names = frozenset(process.name for process in circle)
        for wait in (wait for process in circle for wait in circle_waits(process)):
            if isinstance(wait.name, str) and _is_offered_by(wait.what, wait.name, circle, system):
                key = (wait.what, wait.name)
                found[key] = found.get(key, frozenset()) | names
    return found


def _is_offered_by(what: str, name: str, circle: Collection[Process], system: System) -> bool:
    kinds = (EndpointKind.SERVICE, EndpointKind.ACTION_SERVER, EndpointKind.PUBLISHER)
    return any(
        end.process in circle
        for each in system.connections
        if (each.what, each.name) == (what, name)
        for kind in kinds
        for end in each.of_kind(kind)
    )
