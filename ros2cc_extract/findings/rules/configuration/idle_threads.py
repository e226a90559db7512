"""CC403: more worker threads than callbacks that can ever run at once."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import plural
from ros2cc_extract.findings.waits.capacity import capacity_of
from ros2cc_extract.findings.waits.workers import Workers, workers_of
from ros2cc_extract.source_locations import Place


def find(context: Context) -> Iterator[Hit]:
    """With one group there is nothing to count: that is CC401."""
    workers = workers_of(context.unit.executor)
    if not isinstance(workers, Workers) or workers.is_default or workers.count < 2:
        return
    counts = [*(c.count for c in context.written), *(g.count for g in context.unit.groups)]
    if context.unit.unresolved or not all(isinstance(count, int) for count in counts):
        return
    capacity = capacity_of(context.unit.callbacks, context)
    most = capacity.at_least + _hidden_groups(context)
    if not capacity.unbounded and 1 < most < workers.count and len(groups_of(context)) > 1:
        yield _hit(most, workers, context)


def groups_of(context: Context) -> set[str]:
    """Names of the groups in use."""
    return {callback.group for callback in context.unit.callbacks}


def _hidden_groups(context: Context) -> int:
    """Default groups in which only the services are that rclpy adds to every node."""
    used = groups_of(context)
    seen = {g.node for g in context.unit.groups if g.default and g.name in used}
    return sum(node not in seen for node in context.unit.nodes)


def _hit(most: int, workers: Workers, context: Context) -> Hit:
    executor = context.unit.executor
    at = Place.parse(executor.threads_source) if executor.threads_source else None
    return Hit(
        place=at if at and at.line else context.home(),
        message=f'{plural(workers.count, "thread")}, but the callback groups never let more than '
        f'{most} callbacks run at the same time',
        help=f'num_threads={most} does the same',
        subjects=(executor.name,),
    )


RULE = Rule(
    code='CC403',
    slug='idle-threads',
    severity=Severity.NOTE,
    title='More threads than can ever be used',
    what='The executor has more worker threads than its callback groups ever let run at the same '
    'time. The number is exact: a maximum over groups and exclusive branches. A note.',
    why='A mutually exclusive group lets one callback run at a time, so that its members never '
    'need more than one thread. Source: rclpy 7.1.6 and 9.1.2, `callback_groups.py`.',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.control, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(1.0, self.report)

executor = MultiThreadedExecutor(num_threads=8)
""",
    good="""\
executor = MultiThreadedExecutor(num_threads=2)
""",
    mend='Lower `num_threads`, or name more groups if more should run at once.',
    find=find,
)
