"""CC204: waiting without a time-out for a service to be there, on the only thread."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.waits import Wait, WaitKind, name_of_service, server_of, waits_of
from ros2cc_extract.findings.words import made_at
from ros2cc_extract.findings.workers import is_one_thread
from ros2cc_extract.spec.model import Callback, When


def find(context: Context) -> Iterator[Hit]:
    """A service that the unit itself makes at its start is there already."""
    if not is_one_thread(context.unit.executor):
        return
    for wait in waits_of(context):
        if wait.kind is WaitKind.PRESENCE and not wait.has_timeout:
            on = wait.block.on
            client = context.by_name.get(on) if isinstance(on, str) else None
            if client is not None and not _is_served(client, context):
                yield _hit(wait, client, context)


def _is_served(client: Callback, context: Context) -> bool:
    server = server_of(client, context)
    return server is not None and server.when is When.START


def _hit(wait: Wait, client: Callback, context: Context) -> Hit:
    return Hit(
        place=wait.place,
        message=f'{wait.caller.display_name} waits in {wait.block.call} without a time-out on the '
        f'only thread of the {context.unit.executor.kind or "executor"}: until '
        f'{name_of_service(client)} is there no other callback runs',
        help='wait before the node is spun, or ask service_is_ready and come back by a timer',
        subjects=(wait.caller.name, client.name),
        chain=wait.chain,
        related=tuple(made_at(wait.caller, client)),
    )


RULE = Rule(
    code='CC204',
    slug='absent-service',
    severity=Severity.WARNING,
    title='Waiting for a service to be there on the only thread',
    what='A callback calls `wait_for_service` or `wait_for_server` without a time-out on an '
    'executor with one thread. As long as nobody offers the service, nothing else of the node '
    'runs, its parameter services included.',
    why='`wait_for_service` looks at the graph and sleeps in between; it gives its thread to '
    'nobody. No callback must run for it to end, so it ends when the service is there. Sources: '
    'rclpy 7.1.6 and 9.1.2, `client.py` (`wait_for_service`), `action/client.py` '
    '(`wait_for_server`).',
    bad="""\
class Arm(Node):
    def on_timer(self):
        self.client.wait_for_service()
        self.client.call_async(Trigger.Request())

rclpy.spin(node)
""",
    good="""\
class Arm(Node):
    def on_timer(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request())
""",
    mend='Wait for the service before the node is spun; or ask `service_is_ready()` in a timer.',
    find=find,
)
