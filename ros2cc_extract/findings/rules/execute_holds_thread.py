"""CC203: an execute callback that sleeps on the only thread."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.waits import Wait, WaitKind, waits_of
from ros2cc_extract.findings.words import made_at, served_at
from ros2cc_extract.findings.workers import is_one_thread
from ros2cc_extract.spec.model import EntityKind


def find(context: Context) -> Iterator[Hit]:
    """One finding per execute callback, at its first sleep."""
    if not is_one_thread(context.unit.executor):
        return
    first: dict[str, Wait] = {}
    for wait in waits_of(context):
        if wait.caller.entity is EntityKind.ACTION_EXECUTE and wait.kind is WaitKind.SLEEP:
            first.setdefault(wait.caller.name, wait)
    for wait in first.values():
        yield _hit(wait, context)


def _hit(wait: Wait, context: Context) -> Hit:
    kind = context.unit.executor.kind or 'executor'
    return Hit(
        place=wait.place,
        message=f'{wait.caller.display_name} sleeps while it executes a goal on the only thread '
        f'of the {kind}: no cancel request and no other goal is seen until it has ended',
        help='serve the action with a MultiThreadedExecutor of at least two threads',
        subjects=(wait.caller.name,),
        chain=wait.chain,
        related=(*made_at(wait.caller), *served_at(context.unit.executor, wait.place)),
    )


RULE = Rule(
    code='CC203',
    slug='execute-holds-thread',
    severity=Severity.WARNING,
    title='Execute callback holds the only thread',
    what='The execute callback of an action server sleeps, on an executor with one thread. A '
    'request to cancel is only taken when it has ended, so `is_cancel_requested` stays false.',
    why='The cancel request is taken by the waitable of the action server, which the executor '
    'must run, and its only thread executes the goal. With two threads the cancel arrives at '
    'once, whatever the groups, because execute runs as a task outside them. Sources: rclpy '
    '7.1.6 and 9.1.2, `action/server.py` (`notify_execute`), `executors.py`.',
    bad="""\
class Mover(Node):
    def execute(self, goal_handle):
        while not goal_handle.is_cancel_requested and not self.has_arrived():
            time.sleep(0.1)

rclpy.spin(Mover())
""",
    good="""\
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Mover())
executor.spin()
""",
    mend='Use a `MultiThreadedExecutor` of at least two threads.',
    find=find,
)
