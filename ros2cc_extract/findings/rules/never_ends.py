"""CC109: the model knows a run in which a callback never ends, and no other rule says why."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.model import Remark
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.rules import (
    lock_over_wait,
    one_thread_call,
    own_group_await,
    own_group_call,
    pool_exhausted,
    rate_on_one_thread,
)
from ros2cc_extract.findings.verdicts import (
    PROGRESS,
    refuting_run,
    rests_on_absent_service,
    run_in_which_one_hangs,
)
from ros2cc_extract.findings.waits import Wait, waits_of
from ros2cc_extract.findings.words import plural, shown
from ros2cc_extract.findings.workers import workers_of
from ros2cc_extract.places import Unknown

EXPLAINED = (
    own_group_call,
    one_thread_call,
    pool_exhausted,
    own_group_await,
    rate_on_one_thread,
    lock_over_wait,
)


def find(context: Context) -> Iterator[Hit]:
    """One finding for all callbacks that hang together; only where every fact is known."""
    unit = context.unit
    unknown = unit.unresolved or isinstance(workers_of(unit.executor), Unknown)
    if unknown or any(hit for rule in EXPLAINED for hit in rule.find(context)):
        return
    stuck = [wait for wait in waits_of(context) if wait.needs and _hangs(wait, context)]
    if stuck:
        yield _hit(stuck, context)


def _hangs(wait: Wait, context: Context) -> bool:
    run = refuting_run(PROGRESS, context, wait.caller)
    return run is not None and not rests_on_absent_service(run)


def _hit(stuck: list[Wait], context: Context) -> Hit:
    callers = list({wait.caller.name: wait.caller for wait in stuck}.values())
    threads = plural(len(context.unit.executor.threads), 'thread')
    return Hit(
        place=stuck[0].place,
        message=f'{shown(callers)} may wait for ever on {threads}: the model knows a run after '
        'which nothing moves any more',
        help='do not wait in callbacks that are waited for, or give what they wait for groups of '
        'its own',
        subjects=tuple(callback.name for callback in callers),
        chain=stuck[0].chain,
        related=tuple(
            Remark(wait.place, f'{wait.caller.display_name} waits here in {wait.block.call}')
            for wait in stuck[1:]
        ),
        run=run_in_which_one_hangs(stuck, context),
    )


RULE = Rule(
    code='CC109',
    slug='never-ends',
    severity=Severity.ERROR,
    title='Callbacks that wait for each other',
    what='No single wait is wrong, but together they are: the model of the unit knows a run after '
    'which callbacks wait for each other and nothing moves any more. The run is shown.',
    why='A callback keeps its thread and its mutually exclusive group while it waits. Two '
    'services that call each other each keep the group that the other needs. Decided by the '
    'model of profile `rclpy`, in which a waiting callback stays where it is until what it '
    'needs has run. Sources: rclpy 7.1.6 and 9.1.2, `client.py`, `executors.py`, '
    '`callback_groups.py`.',
    bad="""\
class Arms(Node):            # on_left and on_right each in a group of its own,
    def on_left(self, request, response):     # as are the clients
        return self.right_client.call(request)

    def on_right(self, request, response):
        return self.left_client.call(request)
""",
    good="""\
class Arms(Node):
    def on_left(self, request, response):
        return self.right_client.call(request)

    def on_right(self, request, response):
        return response
""",
    mend='Break the circle: let one of them send by `call_async` and go on in a done-callback.',
    find=find,
)
