"""CC205: waiting for a transform on the thread that must take it."""

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
    waits_of,
    ways_of_others,
    who_waits,
)
from ros2cc_extract.findings.waits.workers import is_one_thread

SHORT_S = 0.1
"""Below this a time-out gets only a note: our choice."""


def find(context: Context) -> Iterator[Hit]:
    if not is_one_thread(context.unit.executor):
        return
    waits = (wait for wait in waits_of(context) if wait.kind is WaitKind.TRANSFORM and wait.needs)
    for alike in at_one_place(waits):
        yield _hit(alike, context)


def _hit(waits: Sequence[Wait], context: Context) -> Hit:
    """One for all callbacks that come to this line."""
    wait = waits[0]
    seconds = wait.block.seconds
    wasted, severity = '', None
    if isinstance(seconds, float):
        wasted = f' {seconds:g} s for nothing'
        severity = Severity.NOTE if seconds < SHORT_S else None
    return Hit(
        place=wait.place,
        message=f'{who_waits(waits)} in {wait.block.call} on the only thread of the '
        f'{context.unit.executor.kind or "executor"}, which must also take what comes on /tf: a '
        f'transform that is not there yet does not come meanwhile, and everything waits{wasted}',
        help='leave the time-out out and come back by a timer, or serve the node with '
        'MultiThreadedExecutor(num_threads=2) or more',
        severity=severity,
        subjects=(*callers_of(waits), *(needed.name for needed in wait.needs)),
        chain=wait.chain,
        related=(
            *made_at(wait.caller, *wait.needs),
            *served_at(context.unit.executor, wait.place),
            *dict.fromkeys(ways_of_others(waits)),
        ),
    )


RULE = Rule(
    code='CC205',
    slug='transform-wait',
    severity=Severity.WARNING,
    title='Wait for a transform on the thread that must receive it',
    what='A callback looks up a transform with a time-out, on an executor with one thread that '
    'also serves the listener of the buffer. A transform that is already there is found at once; '
    'one that is not cannot arrive while the callback waits, so the time-out only costs time. A '
    'time-out below 0.1 s (our choice) gets a note.',
    why='`Buffer.lookup_transform` sleeps and checks again until the time-out. New transforms '
    'arrive by the subscriptions of the `TransformListener`, which the same thread would have to '
    'run. The C++ buffer refuses such a call with a message. Sources: tf2_ros (Jazzy), '
    '`buffer.py`, `transform_listener.py`; rclpy 7.1.6 and 9.1.2, `executors.py`.',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_service(Trigger, 'where', self.on_where)

    def on_where(self, request, response):
        self.buffer.lookup_transform('map', 'arm', Time(), timeout=Duration(seconds=2.0))
        return response

rclpy.spin(Arm())
""",
    good="""\
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Arm())
executor.spin()
""",
    mend='Look up without a time-out and try again in a timer, await `buffer.wait_for_transform_'
    'async`, or give the node a second thread.',
    find=find,
)
