"""CC108: ``asyncio.sleep`` in a coroutine callback."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.findings.waits.waits import ASYNCIO_SLEEP, Wait, waits_of


def find(context: Context) -> Iterator[Hit]:
    for wait in waits_of(context):
        if wait.caller.coroutine and is_real_sleep(wait):
            yield Hit(
                place=wait.place,
                message=f'{wait.caller.display_name} awaits asyncio.sleep, but the executor '
                'runs its coroutine, not asyncio: it raises RuntimeError',
                help='do the rest in a timer that cancels itself, or await a future '
                'that a timer in another callback group sets',
                subjects=(wait.caller.name,),
                chain=wait.chain,
                related=tuple(made_at(wait.caller)),
            )


def is_real_sleep(wait: Wait) -> bool:
    """A sleep of 0 s only yields, which an executor understands."""
    seconds = wait.block.seconds
    return wait.block.call == ASYNCIO_SLEEP and isinstance(seconds, float) and seconds > 0


RULE = Rule(
    code='CC108',
    slug='asyncio-sleep',
    severity=Severity.ERROR,
    title='asyncio.sleep in a coroutine callback',
    what='A coroutine callback awaits `asyncio.sleep`. It raises `RuntimeError: no running event '
    "loop`, or `await wasn't used with future` where a loop runs around the executor.",
    why='An executor runs coroutines itself: its tasks send `None` into them and understand only '
    'rclpy futures. No asyncio loop is involved. Source: rclpy 7.1.6 and 9.1.2, `task.py` '
    '(`Task.__call__`). Measured on 7.1.6: under `rclpy.spin`, a multi-threaded executor, and '
    '`spin_once` within an asyncio loop.',
    bad="""\
class Arm(Node):
    async def on_timer(self):
        self.open_gripper()
        await asyncio.sleep(1.0)
        self.close_gripper()
""",
    good="""\
class Arm(Node):
    def on_timer(self):
        self.open_gripper()
        self.later = self.create_timer(1.0, self.close_gripper)  # which cancels the timer
""",
    mend='Do the rest in a timer that cancels itself, or await a future that a timer '
    'in another callback group sets.',
    find=find,
)
