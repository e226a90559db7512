"""CC109: the model knows a run in which a callback never ends, and no other rule says why."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.model import Remark
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.rules import (
    lock_over_wait,
    nested_spin,
    one_thread_call,
    own_group_await,
    own_group_call,
    pool_exhausted,
    rate_on_one_thread,
)
from ros2cc_extract.findings.stuck import Stuck, stuck_in, why_stuck
from ros2cc_extract.findings.verdicts import (
    PROGRESS,
    refuting_run,
    rests_on_absent_service,
    shown_hang,
)
from ros2cc_extract.findings.waits import waits_in
from ros2cc_extract.findings.words import listing
from ros2cc_extract.findings.workers import Workers, is_one_thread, workers_of
from ros2cc_extract.places import Unknown

EXPLAINED = (
    own_group_call,
    one_thread_call,
    pool_exhausted,
    own_group_await,
    rate_on_one_thread,
    nested_spin,
    lock_over_wait,
)


def find(context: Context) -> Iterator[Hit]:
    """
    One finding for all callbacks that hang together, where all facts are known.

    Who is held up by a wait that another rule explains is no finding of its own.
    """
    if not open_facts(context):
        for together, stuck in unexplained(context):
            yield _hit(together, stuck, context)


def unexplained(context: Context) -> Iterator[tuple[list[Stuck], list[Stuck]]]:
    """Waits that the model refutes and no other rule explains, with all that stands still then."""
    explained = {
        subject for rule in EXPLAINED for hit in rule.find(context) for subject in hit.subjects
    }
    told: set[str] = set()
    for caller in context.written:
        run = refuting_run(PROGRESS, context, caller)
        if run is None or rests_on_absent_service(run) or caller.name in told:
            continue
        stuck = stuck_in(run, context)
        names = {each.callback.name for each in stuck}
        if caller.name in names and not names & explained:
            together = _together(caller.name, stuck)
            told.update(each.callback.name for each in together)
            yield together, stuck


def open_facts(context: Context) -> str:
    """Say what is not known of the unit and might undo a run; empty where all is known."""
    executor = workers_of(context.unit.executor)
    if isinstance(executor, Unknown):
        return f'the executor is not known ({executor.reason})'
    facts = (fact for fact in context.unit.unresolved if fact.fact in _MATTERS)
    fact = next(facts, None)
    return f'{fact.fact} of {fact.subject} is not known ({fact.reason})' if fact else ''


_MATTERS = ('entities', 'group', 'executor', 'function', 'threads')
"""Facts of a unit that may change who runs beside whom, or who ends a wait."""


def _together(first: str, stuck: Sequence[Stuck]) -> list[Stuck]:
    """``first`` and those of the others that stand in its way, which begin with it."""
    names = {first}
    while True:
        needed = {name for each in stuck if each.callback.name in names for name in each.enders}
        wider = names | {each.callback.name for each in stuck if each.callback.name in needed}
        if wider == names:
            return sorted(
                (each for each in stuck if each.callback.name in names),
                key=lambda each: each.callback.name != first,
            )
        names = wider


def _hit(together: list[Stuck], stuck: Sequence[Stuck], context: Context) -> Hit:
    first = together[0]
    who = f'{first.wait.caller.display_name} waits in {waits_in(first.wait)}'
    named = f' for {first.what}' if first.what else ''
    workers = workers_of(context.unit.executor)
    reason = why_stuck(first, stuck, context)
    is_counted = isinstance(workers, Workers) and workers.is_default
    names = [each.callback.name for each in together]
    return Hit(
        place=first.wait.place,
        message=f'{who}{named}, but {reason}: it waits for ever',
        help=_help(first, together, context),
        severity=Severity.WARNING if is_counted else None,
        subjects=tuple(dict.fromkeys([*names, *first.enders])),
        chain=first.wait.chain,
        related=tuple(
            Remark(
                each.wait.place,
                f'{each.callback.display_name} waits here in {waits_in(each.wait)}',
            )
            for each in together[1:]
        ),
        run=shown_hang(first.callback, {*names, *first.enders}, context),
    )


def _help(first: Stuck, together: Sequence[Stuck], context: Context) -> str:
    if not first.enders:
        return 'end it somewhere, or give it a time-out'
    if len(together) > 1:
        return (
            f'break the circle of {listing(each.callback.display_name for each in together)}: '
            'one of them must not wait'
        )
    if is_one_thread(context.unit.executor):
        return (
            f'use MultiThreadedExecutor(num_threads=2) or more, with {listing(first.enders)} in '
            'another group, or look from a timer instead of waiting'
        )
    return (
        f'see to it that {listing(first.enders)} can run while {first.callback.display_name} '
        'waits, or give the wait a time-out'
    )


RULE = Rule(
    code='CC109',
    slug='never-ends',
    severity=Severity.ERROR,
    title='Callback that waits for ever',
    what='The model of the unit knows a run after which a callback waits and nothing moves any '
    'more: nobody ends the wait, or whoever could cannot run, comes too early, or waits itself. '
    'This is the general rule; where a cause has a name of its own, its rule speaks instead. The '
    'run is shown.',
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
    mend='Let whoever ends the wait run beside it: on a thread and in a group of its own. Break a '
    'circle of waits: let one of them send by `call_async` and go on in a done-callback. Give a '
    'wait that nobody may end a time-out.',
    find=find,
)
