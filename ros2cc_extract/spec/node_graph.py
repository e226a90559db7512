"""What nodes of one program have in the graph, by the names that the code gives them."""

from __future__ import annotations

from enum import Enum

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown


class EndpointKind(Enum):
    """What an endpoint is; each has a counterpart that it is connected with."""

    PUBLISHER = 'publisher'
    SUBSCRIPTION = 'subscription'
    SERVICE = 'service'
    CLIENT = 'client'
    ACTION_SERVER = 'action_server'
    ACTION_CLIENT = 'action_client'

    @property
    def counterpart(self) -> EndpointKind:
        """The kind at the other end."""
        return _COUNTERPART[self]

    @property
    def what(self) -> str:
        """What the two share: a topic, a service or an action."""
        return _WHAT[self]


_COUNTERPART = {
    EndpointKind.PUBLISHER: EndpointKind.SUBSCRIPTION,
    EndpointKind.SUBSCRIPTION: EndpointKind.PUBLISHER,
    EndpointKind.SERVICE: EndpointKind.CLIENT,
    EndpointKind.CLIENT: EndpointKind.SERVICE,
    EndpointKind.ACTION_SERVER: EndpointKind.ACTION_CLIENT,
    EndpointKind.ACTION_CLIENT: EndpointKind.ACTION_SERVER,
}
_WHAT = {
    EndpointKind.PUBLISHER: 'topic',
    EndpointKind.SUBSCRIPTION: 'topic',
    EndpointKind.SERVICE: 'service',
    EndpointKind.CLIENT: 'service',
    EndpointKind.ACTION_SERVER: 'action',
    EndpointKind.ACTION_CLIENT: 'action',
}


@dataclass(frozen=True, kw_only=True)
class Qos:
    """
    What of a quality-of-service profile decides which endpoints connect; times in seconds.

    :param reliability: ``reliable``, ``best_effort``; ``None`` where the middleware decides.
    :param durability: ``volatile``, ``transient_local``.
    :param liveliness: ``automatic``, ``manual_by_topic``.
    """

    reliability: str | Unknown | None = None
    durability: str | Unknown | None = None
    deadline_s: float | Unknown | None = None
    liveliness: str | Unknown | None = None
    lease_s: float | Unknown | None = None


CHANGE_STATE, CHANGE_STATE_TYPE = '~/change_state', 'lifecycle_msgs/srv/ChangeState'
"""The service of a life-cycle node that runs its transitions; ``conditional`` of a node whose code
changes its own state too. Source: rclpy 7.1.6, ``lifecycle/node.py``."""


@dataclass(frozen=True, kw_only=True)
class Endpoint:
    """
    A publisher, subscription, service, client, action server or action client.

    :param name: as the code says it, before expansion and remaps.
    :param type: ``package/kind/Name``; ``None`` where it could not be followed.
    :param assumed: the rule by which the name was assumed, as of a parameter's default.
    :param conditional: a branch may skip it.
    :param after: places of the waits that must be over before it is made.
    """

    kind: EndpointKind
    name: str | Unknown
    type: str | None = None
    qos: Qos | None = None
    source: Place | None = None
    conditional: bool = False
    assumed: str | None = None
    after: tuple[Place, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Awaited:
    """
    A service or action that the set-up of a program waits for without an end.

    :param client: place of the client of it.
    :param place: of the wait.
    :param answers: it waits for an answer, not only until a node offers it.
    """

    client: Place
    place: Place
    answers: bool = False


@dataclass(frozen=True, kw_only=True)
class DeclaredParameter:
    """
    A parameter that the code declares with a type, which what a launch sets must have.

    :param conditional: a branch may skip it.
    """

    name: str
    type: str
    source: Place
    conditional: bool = False


@dataclass(frozen=True, kw_only=True)
class NodeGraph:
    """
    A node with what it has in the graph.

    :param name: as the code says; ``namespace`` too, ``''`` where it says none.
    :param entry: where its program starts, as of a unit.
    :param parameters: names that the code declares or asks for; ``None`` where not all are known.
    :param declared: those of them that have a type.
    :param open: why it may have more endpoints than these.
    :param awaits: what its program waits for before it is spun.
    :param apart: why names and remaps that its process is given may not reach it.
    """

    name: str | Unknown
    namespace: str | Unknown = ''
    entry: str | None = None
    endpoints: tuple[Endpoint, ...] = ()
    parameters: tuple[str, ...] | None = ()
    declared: tuple[DeclaredParameter, ...] = ()
    open: Unknown | None = None
    awaits: tuple[Awaited, ...] = ()
    apart: Unknown | None = None
    source: Place | None = None
