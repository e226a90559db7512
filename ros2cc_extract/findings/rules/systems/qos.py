"""CC703: a publisher and a subscription whose quality of service does not match."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.spec.node_graph import EndpointKind
from ros2cc_extract.spec.system.model import End, System
from ros2cc_extract.spec.system.qos_matching import mismatch


def find(system: System) -> Iterator[Hit]:
    for connection in system.connections:
        for sender in connection.of_kind(EndpointKind.PUBLISHER):
            for taker in connection.of_kind(EndpointKind.SUBSCRIPTION):
                offered, asked = sender.endpoint.of.qos, taker.endpoint.of.qos
                why = mismatch(offered, asked) if offered and asked else None
                if why is not None:
                    yield _hit(connection.name, sender, taker, why)


def _hit(topic: str, sender: End, taker: End, why: str) -> Hit:
    return Hit(
        place=taker.endpoint.source or taker.process.launched.source,
        message=f'{taker.node.name} gets nothing of topic {topic} from {sender.node.name}: '
        f'their quality of service does not match ({why})',
        help='offer what is asked for, or ask for what is offered',
        subjects=(topic, str(sender.node.name), str(taker.node.name)),
        related=(
            Remark(
                sender.endpoint.source or sender.process.launched.source,
                f'{sender.node.name} publishes here',
            ),
        ),
    )


RULE = Rule(
    code='CC703',
    slug='qos-mismatch',
    severity=Severity.WARNING,
    title='Publisher and subscription that do not match',
    what='A publisher of the system offers less than a subscription of the same topic asks for: '
    'best effort for reliable, volatile for transient local, automatic for manual liveliness, a '
    'longer deadline or lease than asked for, or none.',
    why='A connection is made only where the subscription asks for no more than the publisher '
    'offers; else no message gets through. Source: docs.ros.org (Jazzy), "Quality of Service '
    'settings", QoS compatibilities.',
    bad="""\
self.create_publisher(Image, 'image', qos_profile_sensor_data)       # best effort
self.create_subscription(Image, 'image', self.on_image, 10)          # asks for reliable
""",
    good="""\
self.create_publisher(Image, 'image', qos_profile_sensor_data)
self.create_subscription(Image, 'image', self.on_image, qos_profile_sensor_data)
""",
    mend='Offer what is asked for, or ask for what is offered.',
)
