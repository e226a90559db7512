"""CC702: one name with two types."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.spec.system.model import Connection, End, System


def find(system: System) -> Iterator[Hit]:
    for connection in system.connections:
        pair = _pair(connection)
        if pair is not None:
            yield _hit(connection, *pair)


def _pair(connection: Connection) -> tuple[End, End] | None:
    """The first two ends that would be connected and have different types."""
    for one in connection.ends:
        for other in connection.of_kind(one.endpoint.kind.counterpart):
            types = (one.endpoint.type, other.endpoint.type)
            if None not in types and types[0] != types[1]:
                return one, other
    return None


def _hit(connection: Connection, one: End, other: End) -> Hit:
    return Hit(
        place=one.endpoint.source or one.process.launched.source,
        message=f'{connection.what} {connection.name} has two types: {one.endpoint.type} by '
        f'{one.node.name}, {other.endpoint.type} by {other.node.name}: they are never connected',
        help='use one type in both, or give one of them another name',
        subjects=(connection.name,),
        related=(
            Remark(
                other.endpoint.source or other.process.launched.source,
                f'{other.node.name} has it as {other.endpoint.type}',
            ),
        ),
    )


RULE = Rule(
    code='CC702',
    slug='two-types',
    severity=Severity.ERROR,
    title='One name with two types',
    what='Two nodes of the system use one topic, service or action with different types.',
    why='Endpoints are matched by name and type; with different types no message, request or goal '
    'gets through, and nothing reports it at run time. Source: design.ros2.org, "Topic and '
    'Service name mapping to DDS" (the type is part of what DDS matches).',
    bad="""\
self.create_publisher(Float32, 'level', 10)                       # in one node
self.create_subscription(Float64, 'level', self.on_level, 10)     # in the other
""",
    good="""\
self.create_publisher(Float64, 'level', 10)
self.create_subscription(Float64, 'level', self.on_level, 10)
""",
    mend='Use one type in both, or give one of them another name.',
)
