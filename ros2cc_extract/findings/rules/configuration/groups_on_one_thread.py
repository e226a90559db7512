"""CC402: groups that let callbacks overlap, on an executor with one thread."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import listing, made_at
from ros2cc_extract.findings.waits.waits import WaitKind, waits_of
from ros2cc_extract.findings.waits.workers import honours_groups, is_one_thread
from ros2cc_extract.spec.model import CallbackGroup

_LETS_OTHERS_RUN = (WaitKind.AWAIT, WaitKind.SPIN, WaitKind.SPUN_FUTURE)


def find(context: Context) -> Iterator[Hit]:
    if not is_one_thread(context.unit.executor) or groups_count(context):
        return
    used = {callback.group for callback in context.written}
    groups = [group for group in context.unit.groups if group.name in used and is_made(group)]
    if groups:
        executor = context.unit.executor
        yield Hit(
            place=groups[0].source or context.home(),
            message=f'{listing(group.name for group in groups)}: no effect, because the '
            f'{executor.kind or "executor"} runs all callbacks one after the other',
            help='serve the node with a MultiThreadedExecutor, or leave the groups out',
            subjects=tuple(group.name for group in groups),
            related=tuple(made_at(*groups[1:])),
        )


def groups_count(context: Context) -> bool:
    """
    True when groups matter on one thread as well.

    Others run while a callback awaits, or inside it while it spins; its own group stays closed.
    """
    if not honours_groups(context.unit.executor):
        return False
    lets_others_run = any(wait.kind in _LETS_OTHERS_RUN for wait in waits_of(context))
    return lets_others_run or any(callback.coroutine for callback in context.written)


def is_made(group: CallbackGroup) -> bool:
    """True for a group that the developer made and that could be followed."""
    hidden = group.default or group.groupless or group.builtin or group.library
    return not hidden and group.unresolved is None


RULE = Rule(
    code='CC402',
    slug='groups-on-one-thread',
    severity=Severity.NOTE,
    title='Callback groups on an executor with one thread',
    what='Callback groups were created, but one thread runs all callbacks one after the other: '
    'neither a reentrant group nor several groups change anything. Not reported where a callback '
    'awaits or spins. A note: a library node may be written for other executors.',
    why='`rclpy.spin` and `SingleThreadedExecutor` run each callback to its end, to an `await`, '
    'or to a nested spin, before the next. Source: rclpy 7.1.6 and 9.1.2, `executors.py` '
    '(`SingleThreadedExecutor`).',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        group = ReentrantCallbackGroup()
        self.create_timer(0.1, self.control, callback_group=group)

rclpy.spin(node)
""",
    good="""\
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(node)
executor.spin()
""",
    mend='Use a `MultiThreadedExecutor`, or leave the groups out.',
    find=find,
)
