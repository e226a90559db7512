"""CC204: waiting without a time-out for a service to be there, on the only thread."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, served_at
from ros2cc_extract.findings.waits.waits import (
    Wait,
    WaitKind,
    at_one_place,
    callers_of,
    name_of_service,
    waits_of,
    ways_of_others,
    who_waits,
)
from ros2cc_extract.findings.waits.workers import is_one_thread
from ros2cc_extract.spec.client_server_pairs import server_of
from ros2cc_extract.spec.model import Callback, EntityKind, When


def find(context: Context) -> Iterator[Hit]:
    """A service that the unit itself makes at its start is there already."""
    if not is_one_thread(context.unit.executor):
        return
    awaited: dict[str, list[Wait]] = {}
    for wait in waits_of(context):
        on = wait.block.on
        if wait.kind is WaitKind.PRESENCE and not wait.has_timeout and isinstance(on, str):
            awaited.setdefault(on, []).append(wait)
    for name, waits in awaited.items():
        client = context.by_name.get(name)
        if client is not None and not _is_served(client, context):
            yield from (_hit(alike, client, context) for alike in at_one_place(waits))


def _is_served(client: Callback, context: Context) -> bool:
    server = server_of(client, context.written)
    return server is not None and server.when is When.START


def _awaited(client: Callback) -> str:
    return name_of_service(client) if isinstance(client.key, str) else 'the server'


def _question(client: Callback) -> str:
    """The call that answers at once whether it is there."""
    is_action = client.entity is EntityKind.ACTION_CLIENT
    return 'server_is_ready' if is_action else 'service_is_ready'


def _hit(waits: Sequence[Wait], client: Callback, context: Context) -> Hit:
    """Of several callbacks that get to one place the first is shown on its way."""
    wait = waits[0]
    return Hit(
        place=wait.place,
        message=f'{who_waits(waits)} in {wait.block.call} for as long as it takes, on the '
        f'only thread of the {context.unit.executor.kind or "executor"}: until '
        f'{_awaited(client)} is there no other callback runs',
        help=f'wait before the node is spun, or ask {_question(client)} and come back by a timer',
        subjects=(*callers_of(waits), client.name),
        chain=wait.chain,
        related=(
            *made_at(wait.caller, client),
            *served_at(context.unit.executor, wait.place),
            *ways_of_others(waits),
        ),
    )


RULE = Rule(
    code='CC204',
    slug='absent-service',
    severity=Severity.WARNING,
    title='Wait for a service on the only thread',
    what='A callback calls `wait_for_service` or `wait_for_server` without a time-out, or again '
    'and again until the service is there, on an executor with one thread. As long as the '
    'service does not exist, nothing else of the node runs, its parameter services included.',
    why='`wait_for_service` checks the graph and sleeps in between; it keeps its thread '
    'meanwhile. It needs no callback to end, so it returns when the service is there. Sources: '
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
    mend='Wait for the service before the node is spun; or ask `service_is_ready()`, '
    'of an action `server_is_ready()`, in a timer.',
    find=find,
)
