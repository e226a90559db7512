"""CC107: an executor spun while it already spins."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, served_at, shown
from ros2cc_extract.findings.rules.deadlocks.nested_spin import is_executor_call, is_global
from ros2cc_extract.findings.waits.waits import (
    Wait,
    WaitKind,
    are_one,
    at_one_place,
    callers_of,
    waits_of,
    ways_of_others,
)
from ros2cc_extract.findings.waits.workers import runs_in_parallel
from ros2cc_extract.spec.releases.table import SPIN_REFUSED_TWICE


def find(context: Context) -> Iterator[Hit]:
    waits = (
        wait
        for wait in waits_of(context)
        if wait.kind is WaitKind.SPIN and _is_of_this_executor(wait, context)
    )
    for alike in at_one_place(waits):
        yield _hit(alike, context)


def _hit(waits: Sequence[Wait], context: Context) -> Hit:
    """One for all callbacks that come to this line: mended there, it is mended for all."""
    wait, executor = waits[0], context.unit.executor
    refused = SPIN_REFUSED_TWICE.holds(context.unit.rclpy)
    runs_others = any(_may_run_others(each, context) for each in waits)
    calls, them = ('calls', 'it') if are_one(waits) else ('call', 'them')
    return Hit(
        place=wait.place,
        message=f'{shown(each.caller for each in waits)} {calls} {wait.block.call} on the '
        f'executor that runs {them}: {_consequence(refused, runs_others=runs_others)}',
        help='do not spin in a callback: use call_async and continue in a done-callback, '
        'or await in a coroutine callback, with what it awaits in another group',
        severity=_severity(refused, runs_others=runs_others),
        subjects=(*callers_of(waits), executor.name),
        chain=wait.chain,
        related=(
            *made_at(wait.caller),
            *served_at(executor, wait.place),
            *dict.fromkeys(ways_of_others(waits)),
        ),
    )


def _severity(refused: bool | None, *, runs_others: bool) -> Severity | None:
    """What runs nothing else does no harm beside the wait, which other rules report."""
    if refused:
        return Severity.ERROR
    return Severity.NOTE if refused is False and not runs_others else None


def _consequence(refused: bool | None, *, runs_others: bool) -> str:
    if refused:
        return 'it raises RuntimeError'
    inside = 'other callbacks run inside this one' if runs_others else 'nothing else can run then'
    if refused is None:
        return f'from rclpy 7.1.9 on a RuntimeError, before that {inside}'
    return inside if runs_others else f'{inside}, and rclpy 7.1.9 and later raise RuntimeError'


def _may_run_others(wait: Wait, context: Context) -> bool:
    """
    Whether the nested spin can run anything, or raise because another thread spins too.

    The group of the waiting callback is closed meanwhile.
    """
    closed = context.exclusive_group(wait.caller)
    if (
        closed is None
        or runs_in_parallel(context.unit.executor)
        or _is_of_another_node(wait, context)
    ):
        return True
    return any(context.exclusive_group(each) is not closed for each in context.written)


def _is_of_this_executor(wait: Wait, context: Context) -> bool:
    """``rclpy.spin…`` of another node uses the global executor, as ``rclpy.spin`` does."""
    if is_executor_call(wait):
        return wait.block.on == context.unit.executor.name
    return _is_of_another_node(wait, context) and is_global(context.unit)


def _is_of_another_node(wait: Wait, context: Context) -> bool:
    """Whether a node is spun that the executor does not serve before."""
    on = wait.block.on
    return not is_executor_call(wait) and on is not None and on not in context.unit.nodes


RULE = Rule(
    code='CC107',
    slug='executor-spun-twice',
    severity=Severity.WARNING,
    title='Executor spun while it is spinning',
    what='An executor is spun from two threads, by two callbacks that may run at the same time, '
    'or inside a callback that it runs itself. `rclpy.spin` and its relatives without '
    '`executor=` all spin one executor, the global one, for any node. Libraries do so too: the '
    'methods of `BasicNavigator` spin their own node with the global executor, which under '
    '`rclpy.spin` runs the callback that calls them.',
    why='The executor uses one generator to find what is ready. From two threads that raises '
    '`ValueError: generator already executing` if both use the same time-out; nested, other '
    'callbacks run inside the waiting one, but members of its group do not; where no other can '
    'run, it is a note for these releases. From rclpy 7.1.9 '
    '(Jazzy) and 9.1.5 (Kilted) on both raise `RuntimeError: Executor is already spinning`. '
    'Sources: rclpy 7.1.6 and 9.1.2, `executors.py` (`wait_for_ready_callbacks`); ros2/rclpy '
    'pull request 1510.',
    bad="""\
class Arm(Node):
    def on_timer(self):
        future = self.client.call_async(Trigger.Request())
        self.executor.spin_until_future_complete(future)
""",
    good="""\
class Arm(Node):
    async def on_timer(self):
        await self.client.call_async(Trigger.Request())  # the client in another group
""",
    mend='Spin an executor once, in one thread, outside callbacks.',
    find=find,
)
