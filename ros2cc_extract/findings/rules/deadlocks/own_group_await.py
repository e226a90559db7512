"""CC104: an ``await`` for a callback of the coroutine's own mutually exclusive group."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.findings.rules.deadlocks.own_group_call import shut_out_by
from ros2cc_extract.findings.waits.remedies import BE_CONCURRENT, is_on_loop
from ros2cc_extract.findings.waits.verdicts import run_in_which_one_hangs, surely_ends
from ros2cc_extract.findings.waits.waits import Wait, WaitKind, waits_for, waits_of
from ros2cc_extract.findings.waits.workers import honours_groups
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Callback


def find(context: Context) -> Iterator[Hit]:
    if not honours_groups(context.unit.executor):
        return
    for wait in waits_of(context):
        shut_out = shut_out_by(wait, context)
        if wait.kind is not WaitKind.AWAIT or shut_out is None:
            continue
        if not surely_ends(wait, context):
            yield _hit(wait, shut_out, context)


def _hit(wait: Wait, shut_out: Callback, context: Context) -> Hit:
    caller = wait.caller.display_name
    group = context.group_of(shut_out)
    is_open = isinstance(context.unit.executor.kind, Unknown)
    where = ' on every executor but the EventsExecutor' if is_open else ''
    message, mend = (
        f'{caller} awaits {waits_for(wait)} while it keeps {group.display_name} closed, '
        f'and {shut_out.display_name} is in that group: it never resumes{where}, and no '
        'other member of the group runs again',
        f'give {shut_out.display_name} a callback group of its own or a reentrant one',
    )
    made = () if is_on_loop(context.unit.executor) else (group,)
    if is_on_loop(context.unit.executor):
        message = (
            f'{caller} awaits {waits_for(wait)}, which only its own next run gives, and its runs '
            'are one by one: it never resumes, and it is never run again'
        )
        mend = BE_CONCURRENT
    return Hit(
        place=wait.place,
        message=message,
        help=mend,
        severity=Severity.WARNING if is_open else None,
        subjects=(wait.caller.name, shut_out.name),
        chain=wait.chain,
        related=tuple(made_at(*dict.fromkeys((wait.caller, shut_out, *made)))),
        run=run_in_which_one_hangs([wait], context),
    )


RULE = Rule(
    code='CC104',
    slug='own-group-await',
    severity=Severity.ERROR,
    title='Await within the own callback group',
    what='A coroutine callback awaits something that only another callback of the same mutually '
    'exclusive group can deliver. No thread is blocked, but the group stays closed forever.',
    why='An `await` releases the thread but not the group: `ending_execution` is called only '
    'when the coroutine has ended. Until then no member of the group runs, and neither does the '
    'client whose answer is awaited. The `EventsExecutor` ignores groups and is not affected. '
    'Sources: rclpy 7.1.6 and 9.1.2, `executors.py` (`_make_handler`), `task.py`. Measured: 0 '
    'completions, and the other timer of the group frozen too.',
    bad="""\
class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.client = self.create_client(Trigger, 'lock')
        self.create_service(Trigger, 'open', self.on_open)

    async def on_open(self, request, response):
        await self.client.call_async(Trigger.Request())
        return response
""",
    good="""\
class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.client = self.create_client(
            Trigger, 'lock', callback_group=MutuallyExclusiveCallbackGroup())
        self.create_service(Trigger, 'open', self.on_open)

    async def on_open(self, request, response):
        await self.client.call_async(Trigger.Request())
        return response
""",
    mend='Put what is awaited into another callback group, or make the group reentrant.',
    find=find,
)
