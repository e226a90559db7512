"""CC201: a long ``time.sleep`` in a callback that keeps others waiting."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.waits import Wait, WaitKind, waits_of
from ros2cc_extract.findings.words import group_words, made_at, shown
from ros2cc_extract.findings.workers import honours_groups, is_one_thread
from ros2cc_extract.spec.model import EntityKind

LONG_SLEEP_S = 1.0
"""From here on a sleep counts as long: our choice."""


def find(context: Context) -> Iterator[Hit]:
    """Execute callbacks are CC203's."""
    for wait in waits_of(context):
        seconds = wait.block.seconds
        if wait.kind is not WaitKind.SLEEP or not isinstance(seconds, float):
            continue
        if seconds >= LONG_SLEEP_S and wait.caller.entity is not EntityKind.ACTION_EXECUTE:
            yield from _hits(wait, seconds, context)


def _hits(wait: Wait, seconds: float, context: Context) -> Iterator[Hit]:
    executor = context.unit.executor
    if is_one_thread(executor):
        others = tuple(c for c in context.written if c != wait.caller)
        held = f'the only thread of the {executor.kind or "executor"}'
    else:
        group = context.exclusive_group(wait.caller)
        if group is None or not group.default or not honours_groups(executor):
            return
        others = tuple(c for c in context.written if c.group == group.name and c != wait.caller)
        held = group_words(group)
    stopped = [*([shown(others)] if others else []), 'the parameter services']
    yield Hit(
        place=wait.place,
        message=f'{wait.caller.display_name} sleeps {seconds:g} s and holds {held}: '
        f'{" and ".join(stopped)} of the node wait that long',
        help='let a timer go on after the pause'
        + ('' if is_one_thread(executor) else ', or give the callback a group of its own'),
        subjects=(wait.caller.name,),
        chain=wait.chain,
        related=tuple(made_at(wait.caller)),
    )


RULE = Rule(
    code='CC201',
    slug='long-sleep',
    severity=Severity.WARNING,
    title='Long sleep in a callback that others wait for',
    what='A callback sleeps for a second or longer while it holds the only thread, or the '
    'default group of its node. Everything else there waits, also the parameter services: '
    '`ros2 param` hangs.',
    why='Every node has six parameter services and a type-description service in its default '
    'group, which is mutually exclusive. On one thread no group helps. Sources: rclpy 7.1.6 and '
    '9.1.2, `node.py`, `parameter_service.py`, `executors.py`. What counts as long, one second, '
    'is our choice.',
    bad="""\
class Arm(Node):
    def on_dock(self, request, response):
        self.publish_speed(0.1)
        time.sleep(5.0)
        self.publish_speed(0.0)
        return response
""",
    good="""\
class Arm(Node):
    def on_dock(self, request, response):
        self.publish_speed(0.1)
        self.timer = self.create_timer(5.0, self.stop)   # stop() cancels the timer
        return response
""",
    mend='Do the second half in a timer callback; or give the callback a group of its own on a '
    'multi-threaded executor.',
    find=find,
)
