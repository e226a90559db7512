"""CC708: a life-cycle node that nothing configures."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.spec.node_graph import CHANGE_STATE, EndpointKind
from ros2cc_extract.spec.system.model import End, System


def find(system: System) -> Iterator[Hit]:
    """Report nothing where the launch itself, or something unknown, may configure the node."""
    if not system.is_whole or system.changes_states:
        return
    for connection in system.connections:
        if not connection.of_kind(EndpointKind.CLIENT):
            for end in connection.of_kind(EndpointKind.SERVICE):
                if end.endpoint.written == CHANGE_STATE and not end.endpoint.conditional:
                    yield _hit(connection.name, end)


def _hit(service: str, end: End) -> Hit:
    name = str(end.node.name)
    return Hit(
        place=end.process.launched.source,
        message=f'{name} has a life cycle, and nobody in the system asks {service}: it stays '
        'unconfigured, and its life-cycle publishers send nothing',
        help='configure and activate it: by a node that asks this service, by an event of the '
        'launch file, or with autostart',
        subjects=(name,),
        related=(Remark(end.node.source, 'this is its code'),) if end.node.source else (),
    )


RULE = Rule(
    code='CC708',
    slug='never-configured',
    severity=Severity.WARNING,
    title='A life-cycle node that nobody configures',
    what='A node of the system has a life cycle, all code of the system is known, and nothing '
    'in it asks the service that changes its state; neither does the launch file emit events, and '
    'the node does not change its state itself.',
    why='A life-cycle node starts unconfigured: `on_configure` and `on_activate` run when a '
    'transition is asked for, and a life-cycle publisher that is not active drops what is '
    'published. Source: design.ros2.org, "Managed nodes"; rclpy 7.1.6, `lifecycle/node.py`, '
    '`lifecycle/publisher.py`.',
    bad="""\
LifecycleNode(package='lidar', executable='driver', name='lidar', namespace='')
""",
    good="""\
LifecycleNode(package='lidar', executable='driver', name='lidar', namespace='', autostart=True)
""",
    mend='Let a node of the system ask `~/change_state`, emit `ChangeState` events in the launch '
    'file, or start the node with `autostart` (Jazzy and later).',
)
