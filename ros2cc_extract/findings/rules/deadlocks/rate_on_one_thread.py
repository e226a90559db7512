"""CC105: ``Rate.sleep`` in a callback of an executor with one thread."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.findings.waits.verdicts import run_in_which_one_hangs
from ros2cc_extract.findings.waits.waits import WaitKind, waits_of
from ros2cc_extract.findings.waits.workers import is_one_thread


def find(context: Context) -> Iterator[Hit]:
    executor = context.unit.executor
    if not is_one_thread(executor):
        return
    for wait in waits_of(context):
        if wait.kind is WaitKind.RATE:
            yield Hit(
                place=wait.place,
                message=f'{wait.caller.display_name} sleeps by a Rate, which a timer of the '
                f'same executor must wake, on the only thread of the '
                f'{executor.kind or "executor"}: it never wakes',
                help='use a timer instead of the loop, or a MultiThreadedExecutor with at least '
                'two threads',
                subjects=(wait.caller.name,),
                chain=wait.chain,
                related=tuple(made_at(wait.caller)),
                run=run_in_which_one_hangs([wait], context),
            )


RULE = Rule(
    code='CC105',
    slug='rate-on-one-thread',
    severity=Severity.ERROR,
    title='Rate.sleep on an executor with one thread',
    what='A callback sleeps by `Rate.sleep`, but the timer that ends the sleep must run on the '
    'thread that sleeps. With simulated time the clock stands still too, because the same thread '
    'serves the `/clock` subscription.',
    why='`create_rate` makes a timer in a private reentrant group of the node; its callback sets '
    'the event for which `sleep` waits, so another thread must run it. The first sleep may '
    'return at once, because the timer was already due, and hide the bug. Sources: rclpy 7.1.6 '
    'and 9.1.2, `timer.py` (`Rate`), `node.py` (`create_rate`). Measured: 0 of 3 sleeps done on '
    'one thread, 9 on four.',
    bad="""\
class Arm(Node):
    def on_command(self, msg):
        rate = self.create_rate(10)
        while self.is_moving:
            self.publish_speed()
            rate.sleep()

rclpy.spin(node)
""",
    good="""\
class Arm(Node):
    def on_command(self, msg):
        self.timer = self.create_timer(0.1, self.step)

    def step(self):
        if not self.is_moving:
            self.timer.cancel()
        else:
            self.publish_speed()
""",
    mend='Let a timer do the work of the loop. Or serve the node with a '
    '`MultiThreadedExecutor` of at least two threads.',
    find=find,
)
