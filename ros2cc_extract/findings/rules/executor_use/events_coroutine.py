"""CC113: a coroutine callback on an events executor of a release that cannot run it."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.findings.waits.workers import EVENTS
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Callback, EntityKind
from ros2cc_extract.spec.releases.table import COROUTINES_IN_EVENTS

_NOT_AWAITED = (EntityKind.SERVICE, EntityKind.SUBSCRIPTION)


def find(context: Context) -> Iterator[Hit]:
    unit = context.unit
    is_mended = COROUTINES_IN_EVENTS.holds(unit.rclpy)
    if unit.executor.kind != EVENTS or is_mended:
        return
    for callback in context.written:
        if callback.coroutine and callback.entity in _NOT_AWAITED:
            yield _hit(callback, None if is_mended is False else Severity.WARNING)


def _hit(callback: Callback, severity: Severity | None) -> Hit:
    is_service = callback.entity is EntityKind.SERVICE
    return Hit(
        place=callback.defined or callback.source or Place(callback.name),
        message=f'{callback.display_name} is a coroutine, which the EventsExecutor runs only '
        'from rclpy 7.1.11 (Jazzy), 9.1.2 (Kilted) and 10.0.1 on; before, '
        + ('the service raises TypeError' if is_service else 'it is never run'),
        help='write it without async, or use a SingleThreadedExecutor',
        severity=severity,
        subjects=(callback.name,),
        related=tuple(made_at(callback)),
    )


RULE = Rule(
    code='CC113',
    slug='events-coroutine',
    severity=Severity.ERROR,
    title='Coroutine callback on an EventsExecutor that cannot run it',
    what='A service or subscription callback is a coroutine, and an `EventsExecutor` serves it. '
    'Releases before 7.1.11 (Jazzy), 9.1.2 (Kilted) and 10.0.1 mistake the coroutine for the '
    'result: a service raises `TypeError` out of the spin, a subscription does nothing. A '
    'warning where the release is not known; `--assume rclpy=7.1.6` sets it.',
    why='`EventsExecutor` checked for a coroutine only after timer callbacks. Sources: rclpy '
    '7.1.6, `events_executor.cpp`; ros2/rclpy issue 1473, pull requests 1478 and 1613. Measured '
    'on 7.1.6.',
    bad="""\
class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.create_service(Trigger, 'open', self.on_open)

    async def on_open(self, request, response):
        return response

executor = EventsExecutor()
executor.add_node(Gate())
executor.spin()
""",
    good="""\
class Gate(Node):
    def on_open(self, request, response):
        return response
""",
    mend='Write the callback without `async`, use another executor, or move to a release that '
    'has the change.',
    find=find,
)
