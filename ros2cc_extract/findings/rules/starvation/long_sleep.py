"""CC201: a long sleep, or a wait with a long time-out, in a callback that others wait for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from math import inf

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import (
    called,
    made_at,
    plural,
    served_at,
    shown,
)
from ros2cc_extract.findings.rules.deadlocks.own_group_call import shut_out_by
from ros2cc_extract.findings.rules.starvation import group_overload
from ros2cc_extract.findings.waits.long_held_locks import LongHold, long_holds
from ros2cc_extract.findings.waits.remedies import AWAIT_SLEEP, is_on_loop
from ros2cc_extract.findings.waits.waits import AnyWait, Wait, WaitKind, waits_of
from ros2cc_extract.findings.waits.workers import honours_groups, is_one_thread
from ros2cc_extract.spec.effects import BUSY_LOOP, OUTSIDE, POLLING_LOOP
from ros2cc_extract.spec.model import Callback, EntityKind, Executor
from ros2cc_extract.verify.results.rates import least_slept_s, period_of

LONG_SLEEP_S = 1.0
"""From here on a sleep counts as long: our choice."""
MISSED = 5
"""So many runs that a timer misses make a shorter sleep long too, from ``SHORTEST_S`` on."""
SHORTEST_S = 0.1
MANY_ROUNDS = 100
"""So many rounds of a loop, where their number is not known, may come together: our choice."""
LISTED = 5
"""How many of the other sleeps are shown."""


def find(context: Context) -> Iterator[Hit]:
    """One finding per callback, at its longest pause; execute callbacks are CC203's."""
    reported: set[str] = set()
    timed = (_as_timed(wait, context) for wait in waits_of(context))
    pauses = (wait for wait in timed if _is_pause(wait) or _is_long_wait(wait, context))
    for _name, waits in groupby(pauses, key=lambda wait: wait.caller.name):
        own = list(waits)
        short = _long_for_timers_s(own[0].caller, context)
        long = [wait for wait in own if seconds_of(wait) >= max(LONG_SLEEP_S, short)]
        if not long:
            sleeps = [wait for wait in own if _is_sleep(wait)]
            long = [wait for wait in sleeps if seconds_of(wait) >= short]
        if not long and least_slept_s(own[0].caller.blocking) >= short:
            long = [wait for wait in own if not wait.block.conditional]
        if long and not _is_told_of_group(own[0].caller, context):
            hits = list(_hits(tuple({wait.place: wait for wait in long}.values()), context))
            reported |= {subject for hit in hits for subject in hit.subjects}
            yield from hits
    for hold in long_holds(context, LONG_SLEEP_S):
        if hold.wait.caller.name not in reported:
            yield _of_lock(hold)


def of_unknown_rounds(context: Context) -> Iterator[Wait]:
    """The sleeps in loops of which nobody knows how long they hold up others, each once."""
    for wait in waits_of(context):
        if not (wait.block.or_more and _is_sleep(wait)) or wait.block.suspends:
            continue
        held_up = _held_up(wait.caller, context)
        is_held = held_up is not None and any(c.name != wait.caller.name for c in held_up[1])
        most = seconds_of(wait) * MANY_ROUNDS
        if is_held and _is_pause(wait) and most >= _long_for_timers_s(wait.caller, context):
            yield wait


def _is_told_of_group(caller: Callback, context: Context) -> bool:
    """Whether CC202 says of a group of one's own that it has no time for the others."""
    hits = () if _holds_services(caller, context) else group_overload.find(context)
    return any(caller.name in hit.subjects for hit in hits)


def _of_lock(hold: LongHold) -> Hit:
    wait, lock = hold.wait, hold.lock
    who = shown(taker for taker, _ in hold.takers)
    verb = 'waits' if len(hold.takers) == 1 else 'wait'
    until = 'until that is over' if hold.seconds is None else 'that long'
    often = ' in each round of a loop' if hold.seconds is None else ''
    return Hit(
        place=wait.place,
        message=f'{called(wait.caller)} {_how_long(wait)}{often} and holds {lock} meanwhile: '
        f'{who}, which also {"takes" if verb == "waits" else "take"} it, {verb} {until}',
        help=f'hold {lock} only while the data is read or written, and sleep without it',
        subjects=(wait.caller.name, lock),
        chain=wait.chain,
        related=tuple(
            Remark(act.source, f'{taker.display_name} takes {lock} here')
            for taker, act in hold.takers
            if act.source is not None
        ),
    )


def _is_pause(wait: Wait) -> bool:
    """Whether it is a sleep, or ends after a time in any case, as one does if nothing comes."""
    if wait.caller.entity is EntityKind.ACTION_EXECUTE:
        return False
    is_timed = wait.block.call in _TIMED | _ENDS and not wait.needs
    return _is_sleep(wait) or is_timed or _is_of_others(wait)


def _is_of_others(wait: AnyWait) -> bool:
    """Whether a device or another program ends it: a read of a socket, a child, a request."""
    wakers = wait.block.wakers
    is_outside = bool(wakers) and all(waker.by == OUTSIDE for waker in wakers)
    return wait.kind in _OUTSIDE and is_outside and wait.has_timeout


_OUTSIDE = frozenset({WaitKind.OTHER, WaitKind.PRESENCE})


def _as_timed(wait: Wait, context: Context) -> Wait:
    """A sleep by a rate lasts a period of its timer, and a join what the thread sleeps."""
    on = wait.block.on
    timer = context.by_name.get(on) if isinstance(on, str) else None
    is_rate = wait.kind is WaitKind.RATE and timer is not None
    if is_rate and timer is not None and not is_one_thread(context.unit.executor):
        return replace(wait, block=replace(wait.block, seconds=timer.period_s))
    slept = _slept_by_awaited(wait, context)
    return replace(wait, block=replace(wait.block, seconds=slept)) if slept else wait


def _slept_by_awaited(wait: Wait, context: Context) -> float:
    """Seconds that the one thread or task sleeps whose end is waited for; none of another wait."""
    by = {waker.by for waker in wait.block.wakers}
    ends = [each for each in context.unit.activities if by == {each.name}]
    if wait.has_timeout or wait.block.call not in _ENDS or not ends:
        return 0.0
    return least_slept_s(ends[0].blocking)


def _is_sleep(wait: AnyWait) -> bool:
    return wait.kind is WaitKind.SLEEP or (wait.kind is WaitKind.RATE and wait.has_timeout)


def _is_long_wait(wait: Wait, context: Context) -> bool:
    """
    Whether it may last so long that a timer misses runs, though other code may end it.

    What nothing can end meanwhile is reported by other rules.
    """
    is_timed = wait.block.call in _ANSWERED and bool(wait.needs)
    if not is_timed or wait.caller.entity is EntityKind.ACTION_EXECUTE:
        return False
    if is_one_thread(context.unit.executor) or shut_out_by(wait, context) is not None:
        return False
    held_up = _held_up(wait.caller, context)
    every = min((period for _, period in _timers(held_up[1] if held_up else ())), default=inf)
    return seconds_of(wait) >= max(LONG_SLEEP_S, MISSED * every)


_TIMED = frozenset(
    {
        'Event.wait',
        'Condition.wait',
        'Condition.wait_for',
        'Queue.get',
        'Queue.put',
        'Thread.join',
        'Process.join',
        'Barrier.wait',
        'Future.result',
        'Lock.acquire',
        'Semaphore.acquire',
        POLLING_LOOP,
    }
)


_ENDS = frozenset({'Thread.join', 'Process.join', 'Future.result', 'Executor.shutdown'})
"""Waits for the end of a thread, a process or a task."""

_ANSWERED = _TIMED | {'client.call'}


def seconds_of(wait: AnyWait) -> float:
    """How long it lasts in all, or may last; none where that is not known."""
    seconds = wait.block.seconds
    return seconds * wait.block.times if isinstance(seconds, (int, float)) else 0.0


def _held_up(caller: Callback, context: Context) -> tuple[str, tuple[Callback, ...]] | None:
    """What a callback holds that has no thread or group of its own, and what waits for it."""
    executor = context.unit.executor
    if is_one_thread(executor):
        others = tuple(c for c in context.written if c != caller)
        return f'the only thread of the {executor.kind or "executor"}', others
    group = context.exclusive_group(caller)
    if group is None or not honours_groups(executor):
        return None
    others = tuple(c for c in context.written if c.group == group.name and c != caller)
    return group.display_name, others


def _long_for_timers_s(caller: Callback, context: Context) -> float:
    """
    From here on a sleep is long for the timers that it holds up.

    What shares a group that was made for it waits by intention, unless a timer does not keep up.
    """
    held_up = _held_up(caller, context)
    every = min((period for _, period in _timers(held_up[1] if held_up else ())), default=inf)
    long = max(SHORTEST_S, MISSED * every)
    return min(LONG_SLEEP_S, long) if _holds_services(caller, context) else long


def _holds_services(caller: Callback, context: Context) -> bool:
    """Whether the services that rclpy makes for each node wait for it too."""
    group = context.exclusive_group(caller)
    return is_one_thread(context.unit.executor) or (group is not None and group.default)


def _timers(callbacks: Iterable[Callback]) -> Iterator[tuple[Callback, float]]:
    for callback in callbacks:
        period = period_of(callback)
        if callback.entity is EntityKind.TIMER and period is not None:
            yield callback, period


def _hits(sleeps: Sequence[Wait], context: Context) -> Iterator[Hit]:
    wait = max(sleeps, key=seconds_of)
    executor = context.unit.executor
    held_up = _held_up(wait.caller, context)
    if held_up is None:
        return
    held, others = held_up
    # One function may serve several entities; as those that wait it counts where it is alone.
    alike = wait.caller.display_name
    distinct = [other for other in others if other.display_name != alike] or others
    stopped = [shown(distinct)] if distinct else []
    if _holds_services(wait.caller, context):
        stopped.append('the parameter services of the node')
    verb = 'waits' if len(distinct) == len(stopped) == 1 else 'wait'
    more = sorted((s for s in sleeps if s is not wait), key=lambda sleep: sleep.place)
    yield Hit(
        place=wait.place,
        message=f'{wait.caller.display_name} {_how_long(wait)}{_how_often(more, wait)} and '
        f'holds {held}: {" and ".join(stopped)} {verb} that long',
        help=_help(wait, executor),
        severity=Severity.NOTE if _is_rare(wait, others) else None,
        subjects=(wait.caller.name,),
        chain=wait.chain,
        related=(
            *made_at(wait.caller),
            *served_at(executor, wait.place),
            *_missing(wait, others),
            *_listed(more),
        ),
    )


def _help(wait: Wait, executor: Executor) -> str:
    if is_on_loop(executor):
        return AWAIT_SLEEP
    own = '' if is_one_thread(executor) else ', or give the callback a group of its own'
    rest = 'do the rest in a timer that cancels itself'
    if _is_of_others(wait):
        rest = 'wait in a thread of its own, or ask without waiting whether something is there'
    elif not _is_sleep(wait):
        rest = 'let a timer look whether it is over'
    return f'return at once, and {rest}{own}'


def _is_rare(wait: Wait, others: Sequence[Callback]) -> bool:
    """Whether it mostly ends sooner, or only the services that rclpy has made wait."""
    is_mostly_there = bool(wait.needs) or wait.kind is WaitKind.PRESENCE
    return not _is_sleep(wait) and (not others or is_mostly_there)


def _missing(wait: Wait, others: Sequence[Callback]) -> Iterator[Remark]:
    """The timers that miss runs meanwhile."""
    slept = max(seconds_of(wait), least_slept_s(wait.caller.blocking))
    for timer, period in _timers(others):
        if timer.source is not None and slept >= MISSED * period:
            yield Remark(timer.source, f'{timer.display_name} is due every {period:g} s')


def _how_long(wait: AnyWait) -> str:
    seconds = wait.block.seconds
    assert isinstance(seconds, (int, float))
    most = ' up to' if wait.block.conditional else ''
    often = ''
    if wait.block.or_more and wait.block.times > 1:
        more = f' {wait.block.times} times or more (at least {seconds_of(wait):g} s in all)'
        often = ' again and again' if most else more
    elif wait.block.times > 1:
        often = f'{most} {wait.block.times} times ({seconds_of(wait):g} s in all)'
    if wait.block.call == BUSY_LOOP:
        return f'asks a clock in a loop for{most} {seconds:g} s{often}'
    if _is_sleep(wait):
        return f'sleeps {seconds:g} s{often}'
    where = f'a {POLLING_LOOP}' if wait.block.call == POLLING_LOOP else wait.block.call
    return f'waits up to {seconds:g} s{often} in {where}'


def _how_often(more: Sequence[Wait], longest: Wait) -> str:
    """A run may take one branch of several: what it waits in all is not known then."""
    if not more:
        return ''
    places = plural(len(more), 'more place')
    total = least_slept_s(longest.caller.blocking)
    if seconds_of(longest) >= LONG_SLEEP_S:
        return f' here, {LONG_SLEEP_S:g} s or longer at {places},'
    if total <= seconds_of(longest):
        return f' here, and sleeps at {places},'
    return f' here, with {places} {total:g} s in all,'


def _listed(more: Sequence[Wait]) -> Iterator[Remark]:
    for wait in more[:LISTED]:
        yield Remark(wait.place, f'{wait.caller.display_name} {_how_long(wait)} here')


RULE = Rule(
    code='CC201',
    slug='long-sleep',
    severity=Severity.WARNING,
    title='Long sleep in a callback that others wait for',
    what='A callback sleeps for a second or longer while it holds the only thread, or the default '
    'group of its node; or for a tenth of a second or longer where a timer there, or in a '
    'mutually exclusive group of their own, misses five runs meanwhile. Everything else there '
    'waits, also the parameter services: `ros2 param` hangs. The same holds for a lock that '
    'is held over a long sleep, or over a loop that sleeps in each iteration, where other '
    'callbacks take the lock: an execute callback that holds it during its whole run delays '
    'the cancel request. A wait with a time-out counts too: it lasts that long if nothing '
    'arrives, also one for a device, a child process or a server (`select.select(…, 1.0)`). So '
    'does a sleep by a `Rate`, a loop that runs until a clock has moved on (`while time.time() < '
    'end`), and a join of a thread that sleeps. It is only a note where a timer misses five runs '
    'but something may end the wait sooner, and where only the services that rclpy itself '
    'creates wait: they are rarely called, and go on afterwards. Iterations of a loop are '
    'counted where their number is known, as the most where the loop may be left before, and '
    'short sleeps are added up where no branch skips them. Each callback has one finding, at its '
    'longest sleep.',
    why='A callback that holds a lock blocks all others that take it for that long, in any group '
    'and on any number of threads; a loop of unknown length counts from 0.1 s for each '
    'iteration. Every node has six parameter services and a type-description service in its '
    'default group, which is mutually exclusive. On one thread, groups do not help. Sources: '
    'rclpy 7.1.6 and 9.1.2, `node.py`, `parameter_service.py`, `executors.py`. What counts as '
    'long (one second, or five runs of a timer) is our choice. Measured with rclpy 7.1.6 and '
    '9.1.2, four threads: a subscription of the default group that sleeps 0.9 s makes a timer of '
    '0.1 s 0.8 s late.',
    bad="""\
class Arm(Node):
    def on_dock(self, request, response):
        self.publish_speed(0.1)
        time.sleep(5.0)
        self.publish_speed(0.0)
        return response
""",
    good="""\
class Arm(Node):
    def on_dock(self, request, response):
        self.publish_speed(0.1)
        self.timer = self.create_timer(5.0, self.stop)   # stop() cancels the timer
        return response
""",
    mend='Do the second half in a timer callback; or give the callback a group of its own on a '
    'multi-threaded executor.',
    find=find,
)
