"""CC107: an executor spun while it already spins."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.rules.nested_spin import is_executor_call
from ros2cc_extract.findings.waits import WaitKind, waits_of
from ros2cc_extract.findings.words import made_at


def find(context: Context) -> Iterator[Hit]:
    executor = context.unit.executor
    for wait in waits_of(context):
        is_own = wait.block.on == executor.name
        if wait.kind is WaitKind.SPIN and is_executor_call(wait) and is_own:
            yield Hit(
                place=wait.place,
                message=f'{wait.caller.display_name} calls {wait.block.call} on the executor '
                'that runs it: from rclpy 7.1.9 on a RuntimeError, before that other callbacks '
                'run inside this one',
                help='do not spin in a callback: use call_async and continue in a done-callback, '
                'or await in a coroutine callback',
                subjects=(wait.caller.name, executor.name),
                chain=wait.chain,
                related=tuple(made_at(wait.caller)),
            )


RULE = Rule(
    code='CC107',
    slug='executor-spun-twice',
    severity=Severity.WARNING,
    title='Executor spun while it spins',
    what='An executor is spun from two threads, or from inside a callback that it runs itself.',
    why='The executor walks through what is ready by one generator. From two threads that ends '
    'in `ValueError: generator already executing`; nested, other callbacks run inside the one '
    'that waits, and members of its group do not. From rclpy 7.1.9 on both raise `RuntimeError: '
    'Executor is already spinning`. Sources: rclpy 7.1.6 and 9.1.2, `executors.py` '
    '(`wait_for_ready_callbacks`); ros2/rclpy pull request 1510.',
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
