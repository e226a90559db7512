"""CC206: awaiting callbacks on an executor that is spun with a time-out, in old releases."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, shown
from ros2cc_extract.findings.waits.waits import WaitKind, waits_of
from ros2cc_extract.findings.waits.workers import SINGLE
from ros2cc_extract.spec.releases.table import TIMEOUT_KEEPS_HARVEST


def find(context: Context) -> Iterator[Hit]:
    """Only where the release is known: the newer ones are not concerned."""
    unit = context.unit
    spun = (unit.executor.spun or '').rpartition('.')[2]
    is_old = TIMEOUT_KEEPS_HARVEST.holds(unit.rclpy) is False
    if not is_old or unit.executor.kind != SINGLE or spun != 'spin_until_future_complete':
        return
    waits = [wait for wait in waits_of(context) if wait.kind is WaitKind.AWAIT]
    awaiting = [wait.caller for wait in waits]
    concerned = [*awaiting, *(needed for wait in waits for needed in wait.needs)]
    others = [callback for callback in context.written if callback not in concerned]
    if awaiting and others:
        yield Hit(
            place=context.home(),
            message=f'with a time-out, rclpy {unit.rclpy} looks for work anew at each step of '
            f'this spin: while {shown(awaiting)} awaits, {shown(others)} may never run',
            help='use rclpy 3.3.11 or later, or spin without a time-out',
            subjects=(unit.executor.name, *(callback.name for callback in awaiting)),
            related=tuple(made_at(*awaiting)),
        )


RULE = Rule(
    code='CC206',
    slug='timeout-harvest',
    severity=Severity.WARNING,
    title='Awaiting callbacks under a spin with a time-out',
    what='A callback awaits, and its single-threaded executor is spun by '
    '`spin_until_future_complete`. With a time-out, releases before 3.3.11 (Humble) resume the '
    'awaiting callback again and again and never reach the others. Reported only where the '
    'release is known: `--assume rclpy=3.3.9`.',
    why='Each step passed the remaining time as a new argument, which discarded what was ready; '
    'the search then began with the suspended coroutine. Sources: rclpy 3.3.9, `executors.py` '
    '(`wait_for_ready_callbacks`); ros2/rclpy issue 1159, pull request 1165; fixed in rclpy '
    '7.1.6 and 9.1.2 as well.',
    bad="""\
class Asker(Node):
    async def on_timer(self):
        await self.client.call_async(Trigger.Request())

executor.spin_until_future_complete(done, timeout_sec=60.0)
""",
    good="""\
executor.spin_until_future_complete(done)
""",
    mend='Move to a later release, or spin without a time-out.',
    find=find,
)
