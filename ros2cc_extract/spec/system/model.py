"""
A system: its processes, their units as today, their nodes with resolved names, their connections.

A process without known code is *outside*: it is known that it runs, not what it does.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import field
from functools import cached_property

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import Spec, Unresolved
from ros2cc_extract.spec.node_graph import DeclaredParameter, Endpoint, EndpointKind
from ros2cc_extract.spec.system.launched import Fact, Launched
from ros2cc_extract.spec.system.names import Naming, Remap


@dataclass(frozen=True, kw_only=True)
class SystemEndpoint:
    """
    An endpoint under the name that it has in the graph.

    :param name: fully resolved.
    :param written: what the code says.
    :param remap: the rule that has renamed it.
    """

    kind: EndpointKind
    name: Fact
    written: Fact
    type: str | None = None
    remap: Remap | None = None
    source: Place | None = None
    conditional: bool = False
    assumed: str | None = None
    of: Endpoint = field(repr=False, compare=False)


@dataclass(frozen=True, kw_only=True)
class SystemAwaited:
    """
    A service or action that a process waits for in its set-up, without an end.

    :param what: ``service`` or ``action``.
    :param answers: it waits for an answer, not only until a node offers it.
    """

    what: str
    name: Fact
    source: Place
    answers: bool = False


@dataclass(frozen=True, kw_only=True)
class SystemNode:
    """
    A node of a process.

    :param name: fully qualified.
    :param own_name: what the code calls it, as the units do.
    :param open: why it may have more endpoints than these.
    :param declared: parameters with a type, where the code was read for this.
    """

    name: Fact
    own_name: Fact
    endpoints: tuple[SystemEndpoint, ...] = ()
    parameters: tuple[str, ...] | None = ()
    open: Unknown | None = None
    awaits: tuple[SystemAwaited, ...] = ()
    source: Place | None = None
    naming: Naming | None = field(default=None, repr=False, compare=False)
    declared: tuple[DeclaredParameter, ...] = field(default=(), repr=False, compare=False)


@dataclass(frozen=True, kw_only=True)
class Process:
    """
    One process.

    :param name: unique in the system.
    :param launched: how the launch file starts it.
    :param file: the Python file that it runs, as shown; ``entry`` where in it, as of its units.
    :param outside: why its code is not known.
    :param whole: its working units in one, with the names that they have together, where there are
        several and the code was read for this.
    """

    name: str
    launched: Launched
    file: str | None = None
    entry: str | None = None
    outside: Unknown | None = None
    nodes: tuple[SystemNode, ...] = ()
    units: tuple[Spec, ...] = ()
    whole: Spec | None = field(default=None, repr=False, compare=False)

    @cached_property
    def working_units(self) -> tuple[Spec, ...]:
        """Its units but those of nodes that have nothing to run, as one for parameters alone."""
        return tuple(unit for unit in self.units if unit.has_work)


@dataclass(frozen=True)
class End:
    """One end of a connection, with its node."""

    process: Process
    node: SystemNode
    endpoint: SystemEndpoint


@dataclass(frozen=True)
class Connection:
    """All ends of one topic, service or action."""

    what: str
    name: str
    ends: tuple[End, ...]

    def of_kind(self, kind: EndpointKind) -> tuple[End, ...]:
        """The ends of a kind."""
        return tuple(end for end in self.ends if end.endpoint.kind is kind)


NOT_FOLLOWED = ('launch', 'action')
"""Subject and fact of what a launch file does and could not be followed: it may start more."""


@dataclass(frozen=True, kw_only=True)
class System:
    """
    What one launch starts.

    :param name: of the launch file.
    :param sources: launch files.
    :param unresolved: what could not be found out.
    :param changes_states: the launch may itself configure or activate life-cycle nodes.
    """

    name: str
    processes: tuple[Process, ...]
    sources: tuple[str, ...] = ()
    unresolved: tuple[Unresolved, ...] = ()
    changes_states: bool = field(default=False, compare=False)

    @property
    def ends(self) -> Iterator[End]:
        """Every endpoint of every node."""
        for process in self.processes:
            for node in process.nodes:
                for endpoint in node.endpoints:
                    yield End(process, node, endpoint)

    @cached_property
    def connections(self) -> tuple[Connection, ...]:
        """The topics, services and actions whose names are known, by name."""
        found: dict[tuple[str, str], list[End]] = defaultdict(list)
        for end in self.ends:
            if isinstance(end.endpoint.name, str):
                found[end.endpoint.kind.what, end.endpoint.name].append(end)
        return tuple(Connection(*key, tuple(ends)) for key, ends in sorted(found.items()))

    @cached_property
    def is_whole(self) -> bool:
        """Whether all that is started, all code and all names are known."""
        are_known = all(
            process.outside is None and all(node.open is None for node in process.nodes)
            for process in self.processes
        )
        is_followed = all((each.subject, each.fact) != NOT_FOLLOWED for each in self.unresolved)
        are_named = all(isinstance(end.endpoint.name, str) for end in self.ends)
        return are_known and is_followed and are_named
