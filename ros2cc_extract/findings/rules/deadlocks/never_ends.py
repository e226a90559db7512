"""CC109: the model has a run in which a callback waits forever, and no other rule says why."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Doer, Hit, Rule
from ros2cc_extract.findings.base.wording import called, listing, made_at, shown
from ros2cc_extract.findings.rules.deadlocks import (
    lock_over_wait,
    nested_spin,
    one_thread_call,
    own_group_await,
    own_group_call,
    pool_exhausted,
    rate_on_one_thread,
)
from ros2cc_extract.findings.waits.exhausted_permits import kept_for, used_up
from ros2cc_extract.findings.waits.remedies import AWAIT_IT, BE_CONCURRENT, is_on_loop
from ros2cc_extract.findings.waits.stuck_callbacks import (
    Stuck,
    is_for_itself,
    is_given_once,
    shut_out_for,
    stuck_in,
    together_with,
    why_stuck,
)
from ros2cc_extract.findings.waits.verdicts import (
    PROGRESS,
    is_of_repeated,
    refuting_run,
    rests_on_absent_service,
    shown_hang,
)
from ros2cc_extract.findings.waits.waits import (
    AnyWait,
    Wait,
    are_one,
    at_one_place,
    callers_of,
    how_long,
    kind_of,
    waits_in,
    ways_of_others,
    who_waits,
)
from ros2cc_extract.findings.waits.workers import Workers, is_one_thread, workers_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import ENDLESS_LOOP, WORKING_LOOP
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback

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
    One finding for all that hang together, where all facts are known.

    A callback held up by a wait that another rule explains is no finding of its own.
    """
    yield from (_unread(alike) for alike in at_one_place(_for_writers(context)))
    yield from (_cleared_late(alike) for alike in at_one_place(_of_lost_answers(context)))
    if not open_facts(context):
        yield from hits_of(context)
        for wait in used_up(context):
            yield _once_used_up(wait, context)


def _all_concern(_together: Sequence[Stuck]) -> bool:
    return True


def hits_of(
    context: Context, concerns: Callable[[Sequence[Stuck]], bool] = _all_concern
) -> Iterator[Hit]:
    """
    One finding for all that hang together.

    :param concerns: whether it is to be reported for those.
    """
    for together, stuck in unexplained(context):
        if concerns(together):
            is_loop = together[0].wait.block.call == ENDLESS_LOOP
            yield _of_loop(together[0], context) if is_loop else _hit(together, stuck, context)


def _for_writers(context: Context) -> Iterator[AnyWait]:
    """Waits for the end of children that wait for a reader of their output."""
    for doer in context.doers:
        blocks = (block for block in doer.blocking if block.unread is not None)
        yield from (AnyWait(doer, block, kind_of(block)) for block in blocks)


def _unread(waits: Sequence[AnyWait]) -> Hit:
    wait = waits[0]
    pipe = f'the pipe of its {wait.block.unread}'
    it = 'it waits' if are_one(waits) else 'they wait'
    return Hit(
        place=wait.place,
        message=f'{who_waits(waits)} in {waits_in(wait)} for a child process while nothing '
        f'reads {pipe}: once the pipe is full, the child waits for a reader, and {it} forever',
        help='use communicate(), which reads while it waits; read the pipe before or in a thread, '
        'or write to a file or DEVNULL',
        severity=Severity.WARNING,
        subjects=callers_of(waits),
        chain=wait.chain,
        related=tuple(ways_of_others(waits)),
    )


def _of_lost_answers(context: Context) -> Iterator[AnyWait]:
    """Waits without a time-out for what may have come before the event was cleared."""
    for doer in context.doers:
        for block in doer.blocking:
            if block.cleared_late is not None and block.seconds is None:
                yield AnyWait(doer, block, kind_of(block))


def _cleared_late(waits: Sequence[AnyWait]) -> Hit:
    wait = waits[0]
    it = 'it waits' if are_one(waits) else 'they wait'
    what, topics = wait.block.resource or 'the event', wait.block.cleared_late
    return Hit(
        place=wait.place,
        message=f'{who_waits(waits)} in {waits_in(wait)} for {what}, which is cleared after the '
        f'message on {topics} is sent: what that brings may have set {what} before, and then {it} '
        'forever',
        help=f'clear {what} before you send the message; or wait with a time-out and look again',
        severity=Severity.WARNING,
        subjects=callers_of(waits),
        chain=wait.chain,
        related=tuple(ways_of_others(waits)),
    )


def _once_used_up(wait: Wait, context: Context) -> Hit:
    givers = tuple(dict.fromkeys(waker.by for waker in wait.block.wakers))
    doers = [context.doer_by_name[name] for name in givers]
    needed = [
        each
        for doer in doers
        if isinstance(doer, Activity)
        for each in kept_for(doer, wait.caller, context)
    ]
    who, what = called(wait.caller), wait.block.resource or 'it'
    by, kept = shown(doers), shown(needed)
    cannot = f'{by} cannot run meanwhile' if givers else 'nothing refills it'
    if needed:
        cannot = f'{by} may then wait for {kept}, which cannot run meanwhile'
    return Hit(
        place=wait.place,
        message=f'{who} waits in {waits_in(wait)} for {what} once that is used up, and '
        f'{cannot}: {how_long(wait)}',
        help=f'let {kept or by} run beside {who}, on a thread and in a group of its own, or do '
        'not wait'
        if givers
        else 'end it somewhere, or give it a time-out',
        severity=Severity.WARNING,
        subjects=(wait.caller.name, *givers),
        chain=wait.chain,
        related=tuple(made_at(wait.caller, *doers, *needed)),
    )


def unexplained(context: Context) -> Iterator[tuple[list[Stuck], list[Stuck]]]:
    """Waits that the model refutes and no other rule explains, with all that stands still then."""
    explained = {
        subject for rule in EXPLAINED for hit in rule.find(context) for subject in hit.subjects
    }
    reported: set[str] = set()
    for caller in context.doers:
        run = refuting_run(PROGRESS, context, caller)
        if run is None or rests_on_absent_service(run) or caller.name in reported:
            continue
        stuck = stuck_in(run, context)
        names = {each.doer.name for each in stuck}
        if caller.name in names and not names & explained:
            together = together_with(caller.name, stuck)
            block = together[0].wait.block
            # A thread that the program ends at its end waits as long as it is meant to.
            if block.call == WORKING_LOOP or block.at_end is not None:
                continue
            reported.update(each.doer.name for each in together)
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
"""Facts of a unit that may change which callbacks overlap, or what ends a wait."""


def _hit(together: list[Stuck], stuck: Sequence[Stuck], context: Context) -> Hit:
    first = together[0]
    who = f'{called(first.doer)} waits in {waits_in(first.wait)}'
    named = f' for {first.what}' if first.what else ''
    workers = workers_of(context.unit.executor)
    reason = why_stuck(first, stuck, context)
    is_counted = isinstance(workers, Workers) and workers.is_default
    names = [each.doer.name for each in together]
    repeated = _repeated(stuck) if is_of_repeated(first.doer, context) else ()
    where = _where_repeated(repeated)
    severity = Severity.WARNING if is_counted or _keeps_the_program(first) else None
    return Hit(
        place=first.wait.place,
        message=f'{who}{named}, but {reason}: {how_long(first.wait)}{where}',
        help=_help_where_repeated(repeated) if where else _help(first, together, context),
        severity=Severity.NOTE if where else severity,
        subjects=tuple(dict.fromkeys([*names, *first.enders])),
        chain=first.wait.chain,
        related=tuple(
            Remark(
                each.wait.place,
                f'{called(each.doer)} waits here in {waits_in(each.wait)}',
            )
            for each in together[1:]
            if each.wait.place != first.wait.place
        ),
        run=shown_hang(first.doer, {*names, *first.enders}, context),
    )


def _of_loop(stuck: Stuck, context: Context) -> Hit:
    """A callback that never ends is an error where another one never runs again by that."""
    held, by = _shut_out_by(stuck.doer, context)
    who = called(stuck.doer)
    so = f'{listing(map(called, held))} never run{"s" * (len(held) == 1)} again, as {by}'
    itself = 'what arrives for it later is never taken'
    return Hit(
        place=stuck.wait.place,
        message=f'{who} never leaves this loop: {so if held else itself}',
        help='do one round of the loop in a timer, or run the loop in a thread of its own',
        severity=None if held else Severity.NOTE,
        subjects=(stuck.doer.name, *(each.name for each in held)),
        chain=stuck.wait.chain,
        related=tuple(made_at(stuck.doer, *held)),
        run=shown_hang(stuck.doer, {stuck.doer.name}, context),
    )


def _shut_out_by(doer: Doer, context: Context) -> tuple[list[Callback], str]:
    """The user's callbacks that cannot run while ``doer`` does, and why."""
    others = [each for each in context.written if each.name != doer.name]
    executor = context.unit.executor
    if is_one_thread(executor):
        return others, f'{called(doer)} holds the only thread of the executor'
    group = context.exclusive_group(doer) if isinstance(doer, Callback) else None
    shut = [each for each in others if group is not None and context.group_of(each) == group]
    if shut and group is not None:
        return shut, f'{group.display_name} is closed'
    endless = [each for each in context.written if _is_endless(each)]
    workers = workers_of(executor)
    if isinstance(workers, Workers) and not workers.is_default and len(endless) >= workers.count:
        held = [each for each in others if each not in endless]
        return held, f'no thread is left: {listing(map(called, endless))} hold them'
    return [], ''


def _is_endless(callback: Callback) -> bool:
    loops = (block for block in callback.blocking if block.call == ENDLESS_LOOP)
    return any(block.escapes is None for block in loops)


def _repeated(stuck: Sequence[Stuck]) -> tuple[Doer, ...]:
    """The callbacks that stand still in several runs at a time."""
    doers = [each.doer for each in stuck]
    return tuple(dict.fromkeys(doer for doer in doers if doers.count(doer) > 1))


def _where_repeated(repeated: Sequence[Doer]) -> str:
    if not repeated:
        return ''
    itself = 'itself' if len(repeated) == 1 else 'themselves'
    return f' where {listing(map(called, repeated))} may overlap {itself} so often'


def _help_where_repeated(repeated: Sequence[Doer]) -> str:
    names = listing(map(called, repeated))
    return f'put {names} into a mutually exclusive group of its own, with a thread to spare'


_KEEPING = ('Event.wait', 'asyncio.Event.wait', 'await')


def _keeps_the_program(stuck: Stuck) -> bool:
    """What no other code touches may be meant to keep ``main`` from its end."""
    is_main = isinstance(stuck.doer, Activity) and stuck.doer.kind is ActivityKind.MAIN
    return is_main and not stuck.enders and stuck.wait.block.call in _KEEPING


def _help(first: Stuck, together: Sequence[Stuck], context: Context) -> str:
    if not first.enders:
        return 'end it somewhere, or give it a time-out'
    if first.wait.block.forgets:
        return (
            'ask for what is waited for before waiting, under the lock and in a loop '
            '(`while not self.ready: self.condition.wait()`), or give the wait a time-out'
        )
    served = [name for name in first.enders if name in context.by_name]
    if len(together) > 1:
        return (
            f'break the circle of {listing(called(each.doer) for each in together)}: '
            'one of them must not wait'
        )
    if is_on_loop(context.unit.executor) and is_for_itself(first):
        return BE_CONCURRENT
    if is_on_loop(context.unit.executor) and not first.wait.block.suspends:
        return AWAIT_IT
    if served and not first.wait.block.suspends and is_one_thread(context.unit.executor):
        return (
            f'use MultiThreadedExecutor(num_threads=2) or more, with {listing(served)} in '
            'another group, or look from a timer instead of waiting'
        )
    shut_out = shut_out_for(first, together, context)
    if shut_out:
        return f'give {listing(shut_out)} a callback group of its own, or the wait a time-out'
    if is_given_once(first, context):
        return 'take only what is there, without waiting, or give the wait a time-out'
    return (
        f'see to it that {listing(first.enders)} can run while {called(first.doer)} '
        'waits, or give the wait a time-out'
    )


RULE = Rule(
    code='CC109',
    slug='never-ends',
    severity=Severity.ERROR,
    title='Wait that never ends',
    what='The model of the unit has a run after which a callback, `main` or a thread waits and '
    'nothing can move any more: nothing ends the wait, or what could end it cannot run, comes '
    'too early, gives no more than earlier waits use up, or waits itself. This is the general '
    'rule; a more specific rule reports the wait where one applies. Executors of one program '
    'that run at the same time and wait for each other are checked together. The run is shown. '
    'A callback that never leaves a `while True:` or `while rclpy.ok():` is one too where others '
    'share its thread or its group, and a note where none does. '
    'A note: several runs of one reentrant callback at the same time are needed to hold all '
    'threads or a lock; whether so many occur depends on the rates. A warning: earlier runs use '
    'up a bounded queue or a semaphore, and what refills it, or what the refilling thread waits '
    'for, cannot run during the wait; or the callback waits for a child process while nothing '
    'reads the pipe that it writes to.',
    why='A thread that is not a daemon keeps the process alive. A callback keeps its thread and '
    'its mutually exclusive group while it waits. Two services that call each other each keep '
    'the group that the other needs. The model of profile `rclpy` decides: in it, a waiting '
    'callback stays where it is until what it needs has run. A pipe holds 64 KiB on Linux; a '
    'child that writes more waits for a reader. Sources: Python 3.12, library reference, '
    '`subprocess` (`Popen.wait`); pipe(7); rclpy 7.1.6 and 9.1.2, `client.py`, `executors.py`, '
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
    mend='Let what ends the wait run beside it: on a thread and in a group of its own. Break a '
    'circle of waits: let one of them send by `call_async` and go on in a done-callback. Give a '
    'wait that nobody may end a time-out. Do the rounds of an endless loop in a timer, or run the '
    'loop in a thread of its own.',
    find=find,
)
