"""CC101: a blocking wait for a callback of the caller's own mutually exclusive group."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import listing, made_at
from ros2cc_extract.findings.waits.verdicts import run_in_which_one_hangs, surely_ends
from ros2cc_extract.findings.waits.waits import (
    Wait,
    WaitKind,
    all_wait_for,
    are_one,
    at_one_place,
    callers_of,
    how_it_ends,
    polls_for_a_time,
    waits_in,
    waits_of,
    ways_of_others,
    who_waits,
)
from ros2cc_extract.findings.waits.workers import honours_groups, is_one_thread
from ros2cc_extract.spec.client_server_pairs import is_client
from ros2cc_extract.spec.model import Callback

BLOCKING = (WaitKind.ANSWER, WaitKind.SIGNAL)


def find(context: Context) -> Iterator[Hit]:
    """On one thread the group is not what blocks, which is CC102, unless it spins meanwhile."""
    executor = context.unit.executor
    one_thread = is_one_thread(executor)
    found: list[Wait] = []
    for wait in waits_of(context):
        counts = wait.kind is WaitKind.SPUN_FUTURE and honours_groups(executor)
        is_blocking = wait.kind in BLOCKING or polls_for_a_time(wait)
        if counts or (is_blocking and not one_thread):
            is_shut_out = shut_out_by(wait, context) is not None
            if is_shut_out and not surely_ends(wait, context):
                found.append(wait)
    by_group: dict[str, list[Wait]] = {}
    for wait in found:
        by_group.setdefault(wait.caller.group, []).append(wait)
    for in_group in by_group.values():
        for alike in at_one_place(in_group):
            yield _hit(alike, context)


def shut_out_by(wait: Wait, context: Context) -> Callback | None:
    """The callback that ``wait`` needs and that its own group keeps from running."""
    group = context.exclusive_group(wait.caller)
    if group is None:
        return None
    return next((needed for needed in wait.needs if needed.group == group.name), None)


def _instead(wait: Wait) -> str:
    """The other way out; code that waits for an event has no call to make asynchronous."""
    is_signal = wait.kind is WaitKind.SIGNAL
    return '' if is_signal else ', or use call_async and continue in a done-callback'


def _hit(waits: Sequence[Wait], context: Context) -> Hit:
    """Of several callbacks that get to one place the first is shown on its way."""
    wait = waits[0]
    shut_out = [one for each in waits if (one := shut_out_by(each, context)) is not None]
    shut_out = list({one.name: one for one in shut_out}.values())
    group = context.group_of(wait.caller)
    caller = wait.caller.display_name if are_one(waits) else 'one of them'
    return Hit(
        place=wait.place,
        message=f'{who_waits(waits)} in {waits_in(wait)} for {all_wait_for(waits)}, but '
        f'{_blocked(shut_out, wait)} in {group.display_name}, which is closed while {caller} '
        f'runs: {how_it_ends(waits)}',
        help=f'{_apart(shut_out)}{_instead(wait)}',
        severity=Severity.WARNING if wait.has_timeout else None,
        subjects=(*callers_of(waits), *(one.name for one in shut_out)),
        chain=wait.chain,
        related=(*made_at(wait.caller, shut_out[0], group), *ways_of_others(waits)),
        run=run_in_which_one_hangs(waits, context),
    )


def what(callback: Callback) -> str:
    """Name what the reader has to move: a client has no function of its own."""
    return 'the client' if is_client(callback) else callback.display_name


def _apart(shut_out: Sequence[Callback]) -> str:
    if len(shut_out) == 1:
        return f'give {what(shut_out[0])} a callback group of its own'
    return f'give {_together(shut_out)} another callback group'


def _together(shut_out: Sequence[Callback]) -> str:
    are_clients = all(map(is_client, shut_out))
    return 'the clients' if are_clients else listing(one.display_name for one in shut_out)


def _blocked(shut_out: Sequence[Callback], wait: Wait) -> str:
    first = shut_out[0]
    if len(shut_out) > 1:
        return f'{_together(shut_out)} are'
    if is_client(first):
        return 'the client is'
    if first is wait.needs[0]:
        return f'{first.display_name} is'
    return f'{first.display_name}, which serves it, is'


RULE = Rule(
    code='CC101',
    slug='own-group-call',
    severity=Severity.ERROR,
    title='Blocking call into its own callback group',
    what='A callback waits synchronously for something that only another callback of the same '
    'mutually exclusive group can deliver: the answer of a client in that group, a service of '
    'that group, or an event that a member of the group sets. More threads do not help, and '
    'neither does a nested spin: the group stays closed meanwhile.',
    why='The group is closed from `beginning_execution` until `ending_execution` of the caller, '
    'and the executor neither waits for nor runs members of a closed group. `Client.call` '
    'waits for a `threading.Event` that is set when the executor has run the client. '
    'Sources: rclpy 7.1.6 and 9.1.2, `callback_groups.py` (`MutuallyExclusiveCallbackGroup`), '
    '`executors.py` (`_wait_for_ready_callbacks`), `client.py` (`Client.call`). Measured on both '
    'versions: 0 completed calls on 1 and on 4 threads.',
    bad="""\
class Navigator(Node):
    def __init__(self):
        super().__init__('navigator')
        self.client = self.create_client(Trigger, 'map_ready')
        self.create_timer(0.5, self.drive)

    def drive(self):
        self.client.call(Trigger.Request())
""",
    good="""\
class Navigator(Node):
    def __init__(self):
        super().__init__('navigator')
        self.client = self.create_client(
            Trigger, 'map_ready', callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.drive)

    def drive(self):
        self.client.call(Trigger.Request())  # with at least two threads
""",
    mend='Put the client into a callback group of its own and serve the node with a '
    '`MultiThreadedExecutor` of at least two threads; or send the request by `call_async` and '
    'do the rest in a done-callback.',
    find=find,
)
