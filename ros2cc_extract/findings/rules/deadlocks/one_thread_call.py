"""CC102: a blocking wait for another callback on an executor with one thread."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.findings.rules.deadlocks.own_group_call import BLOCKING, shut_out_by, what
from ros2cc_extract.findings.waits.remedies import AWAIT_IT, is_on_loop
from ros2cc_extract.findings.waits.verdicts import run_in_which_one_hangs, surely_ends
from ros2cc_extract.findings.waits.waits import (
    Wait,
    all_wait_for,
    at_one_place,
    callers_of,
    how_it_ends,
    polls_for_a_time,
    waits_in,
    waits_of,
    ways_of_others,
    who_waits,
)
from ros2cc_extract.findings.waits.workers import is_one_thread
from ros2cc_extract.spec.client_server_pairs import is_client, is_done_callback


def find(context: Context) -> Iterator[Hit]:
    if not is_one_thread(context.unit.executor):
        return
    waits = [
        wait
        for wait in waits_of(context)
        if (wait.kind in BLOCKING or polls_for_a_time(wait))
        and wait.needs
        and not surely_ends(wait, context)
    ]
    for alike in at_one_place(waits):
        yield _hit(alike, context)


def _hit(waits: Sequence[Wait], context: Context) -> Hit:
    """Of several callbacks that get to one place the first is shown on its way."""
    wait = waits[0]
    executor = context.unit.executor
    is_answer = is_client(wait.needs[0]) or is_done_callback(wait.needs[0])
    one = len(dict.fromkeys(_names(waits))) == len(wait.needs)
    stuck = f'nothing can take {"it" if one else "them"}' if is_answer else 'it cannot run'
    return Hit(
        place=wait.place,
        message=f'{who_waits(waits)} in {waits_in(wait)} for {all_wait_for(waits)} on '
        f'the only thread of the {executor.kind or "executor"}, so {stuck}: {how_it_ends(waits)}',
        help=_help(wait, is_answer, context),
        severity=Severity.WARNING if wait.has_timeout else None,
        subjects=(*callers_of(waits), *_names(waits)),
        chain=wait.chain,
        related=(*made_at(wait.caller, *wait.needs), *ways_of_others(waits)),
        run=run_in_which_one_hangs(waits, context),
    )


def _names(waits: Sequence[Wait]) -> Iterator[str]:
    """Of what is waited for, each once."""
    yield from dict.fromkeys(needed.name for wait in waits for needed in wait.needs)


def _help(wait: Wait, is_answer: bool, context: Context) -> str:
    if is_on_loop(context.unit.executor):
        return AWAIT_IT
    shut_out = shut_out_by(wait, context)
    group = f' and give {what(shut_out)} a group of its own' if shut_out else ''
    other = 'call_async and go on in a done-callback' if is_answer else 'look from a timer'
    return (
        f'use MultiThreadedExecutor(num_threads=2) or more{group}, or {other} instead of waiting'
    )


RULE = Rule(
    code='CC102',
    slug='one-thread-call',
    severity=Severity.ERROR,
    title='Blocking call on an executor with one thread',
    what='A callback waits synchronously for something that another callback of the same '
    'executor must deliver, and that executor has one thread: the one that waits.',
    why='`rclpy.spin` and `SingleThreadedExecutor` run every callback in the spinning thread; a '
    '`MultiThreadedExecutor(num_threads=1)` has one worker, and the spinning thread runs no '
    'callbacks. The `EventsExecutor` is single-threaded too. Sources: rclpy 7.1.6 and 9.1.2, '
    '`executors.py`, `experimental/events_executor.py`, `client.py`. Measured: 0 completed calls '
    'on one thread, with any groups.',
    bad="""\
class Navigator(Node):
    def __init__(self):
        super().__init__('navigator')
        self.client = self.create_client(Trigger, 'map_ready')
        self.create_timer(0.5, self.drive)

    def drive(self):
        self.client.call(Trigger.Request())

rclpy.spin(Navigator())
""",
    good="""\
class Navigator(Node):
    def __init__(self):
        super().__init__('navigator')
        self.client = self.create_client(Trigger, 'map_ready')
        self.create_timer(0.5, self.drive)

    def drive(self):
        self.client.call_async(Trigger.Request()).add_done_callback(self.go_on)

rclpy.spin(Navigator())
""",
    mend='Do not wait in a callback: send by `call_async` and continue in a done-callback. Or '
    'serve the node with a `MultiThreadedExecutor` of at least two threads and keep the client '
    'in another group than the caller.',
    find=find,
)
