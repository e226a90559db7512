"""CC103: as many callbacks may wait at once as there are worker threads."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import called, listing, plural, shown
from ros2cc_extract.findings.rules.deadlocks.own_group_call import shut_out_by
from ros2cc_extract.findings.waits.capacity import Capacity, capacity_of
from ros2cc_extract.findings.waits.stuck_callbacks import waits_in_circle
from ros2cc_extract.findings.waits.verdicts import is_of_repeated, run_in_which_one_hangs
from ros2cc_extract.findings.waits.waits import Wait, WaitKind, how_long, kind_of, waits_of
from ros2cc_extract.findings.waits.workers import Workers, is_one_thread, workers_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Callback, EntityKind, When
from ros2cc_extract.spec.self_exclusion import admits_one, lets_one_wait

_MADE_BY_CALLBACKS = (EntityKind.DONE_CALLBACK, EntityKind.TASK)
_TASK = 'no group holds a task: do not wait in it'
_OUTSIDE = {
    EntityKind.ACTION_EXECUTE: 'no group holds an execute callback: accept one goal at a time in '
    'goal_callback',
    EntityKind.DONE_CALLBACK: 'no group holds a done-callback: do not wait in it',
}
USUAL_CPUS = 4
"""CPUs of a usual robot computer: with fewer waiters a default pool gets only a note."""


def find(context: Context) -> Iterator[Hit]:
    """
    One thread is CC102's case, and a wait that never ends by itself is CC101's.

    Without a known executor there is no number to compare with.
    """
    executor = context.unit.executor
    if is_one_thread(executor) or isinstance(executor.kind, Unknown):
        return
    everything = list(waits_of(context))
    waits = [wait for wait in everything if _holds_a_worker(wait, context)]
    hits = list(_found(waits, context)) if waits else []
    yield from hits
    if not hits:
        looping = [wait for wait in everything if _looks_again(wait, context)]
        yield from _found_looping([*waits, *looping], context) if looping else ()


def _found(waits: Sequence[Wait], context: Context) -> Iterator[Hit]:
    callers = {wait.caller.name: wait.caller for wait in waits}
    capacity = capacity_of(tuple(callers.values()), context)
    unbounded = tuple(
        caller
        for caller in capacity.unbounded
        if not lets_one_wait(caller) and not admits_one(caller, context.unit)
    )
    capacity = replace(capacity, unbounded=unbounded)
    for hit in _judge(waits, capacity, workers_of(context.unit.executor)):
        first = [wait for wait in waits if wait.caller.name == hit.subjects[0]]
        run = run_in_which_one_hangs(first, context)
        rests_on_rates = any(is_of_repeated(wait.caller, context) for wait in first)
        is_shown = run is not None and not rests_on_rates
        is_shown = is_shown and _is_of_endless_services(hit, waits, context)
        severity = Severity.WARNING if is_shown and hit.severity is Severity.NOTE else hit.severity
        yield replace(hit, run=run, severity=severity)


def _is_of_endless_services(hit: Hit, waits: Sequence[Wait], context: Context) -> bool:
    """
    Whether it is about services that wait without a time-out, on a known number of threads.

    Any client may ask while another one waits: what the model shows then is no matter of speed.
    """
    workers = workers_of(context.unit.executor)
    own = [wait for wait in waits if wait.caller.name in hit.subjects]
    is_counted = isinstance(workers, Workers) and not workers.is_default
    are_services = all(wait.caller.entity is EntityKind.SERVICE for wait in own)
    return is_counted and are_services and not any(wait.has_timeout for wait in own)


def _found_looping(waits: Sequence[Wait], context: Context) -> Iterator[Hit]:
    """
    Loops that look again and again, and end otherwise too, take all the threads.

    Only where their number is exact: what could end them runs when the first is over.
    """
    callers = {wait.caller.name: wait.caller for wait in waits}
    capacity = capacity_of(tuple(callers.values()), context)
    workers = workers_of(context.unit.executor)
    if isinstance(workers, Unknown) or workers.is_default or capacity.at_least < workers.count:
        return
    kept = tuple(
        dict.fromkeys(c for wait in waits for c in wait.needs if c not in callers.values())
    )
    if kept:
        rest = (
            f'on {plural(workers.count, "thread")}: then none is left for {shown(kept)}, and what '
            'would end the loops comes when one is over'
        )
        yield _hit(waits, capacity, rest, Severity.WARNING)


def _looks_again(wait: Wait, context: Context) -> bool:
    """Whether it loops, with pauses, until another callback writes something, or time is over."""
    sleeps = any(kind_of(block) is WaitKind.SLEEP for block in wait.caller.blocking)
    is_loop = wait.block.call == 'polling loop' and wait.has_timeout and sleeps
    is_made = wait.caller.when is When.CALLBACK
    return is_loop and not is_made and bool(wait.needs) and shut_out_by(wait, context) is None


def _holds_a_worker(wait: Wait, context: Context) -> bool:
    """Entities that a callback makes are left out: they may replace others."""
    if wait.caller.when is When.CALLBACK and wait.caller.entity not in _MADE_BY_CALLBACKS:
        return False
    if wait.kind is WaitKind.RATE:
        return True
    needed = wait.kind in (WaitKind.ANSWER, WaitKind.SIGNAL) and bool(wait.needs)
    is_of_pool = needed and shut_out_by(wait, context) is None
    return is_of_pool and not waits_in_circle(wait.caller, context)


def _judge(waits: Sequence[Wait], capacity: Capacity, workers: Workers | Unknown) -> Iterator[Hit]:
    if isinstance(workers, Unknown):
        if capacity.at_least > 1:
            rest = f'on a number of threads that is not known ({workers})'
            yield _hit(waits, capacity, rest, Severity.NOTE)
    elif workers.is_default and capacity.at_least > 1:
        rest = (
            f'with as many threads as CPUs, so on a machine with {capacity.at_least} or fewer '
            f'CPUs no thread is left for {_awaited(waits)} and {_what_becomes_of(waits)}'
        )
        usual = capacity.at_least >= USUAL_CPUS
        yield _hit(waits, capacity, rest, Severity.WARNING if usual else Severity.NOTE)
    elif not workers.is_default and capacity.at_least >= workers.count:
        rest = (
            f'on {plural(workers.count, "thread")}: then none is left for {_awaited(waits)} and '
            f'{_what_becomes_of(waits)}'
        )
        timed = all(wait.has_timeout for wait in waits)
        yield _hit(waits, capacity, rest, Severity.WARNING if timed else None)
    elif capacity.unbounded:
        yield _overlap_hit(waits, capacity, workers)


def _what_becomes_of(waits: Sequence[Wait]) -> str:
    """A wait with a time-out ends, and gives a thread back to the others."""
    if all(wait.has_timeout for wait in waits):
        return 'all waits time out'
    if any(wait.has_timeout for wait in waits):
        return 'all wait, at least until the first time-out'
    if all(wait.block.recursive for wait in waits):
        return how_long(waits[0], is_one=False)
    return 'all wait forever'


def _awaited(waits: Sequence[Wait]) -> str:
    """What needs one more thread."""
    kinds = {wait.kind for wait in waits}
    if kinds == {WaitKind.RATE}:
        return 'the timer that ends the sleep' if len(waits) == 1 else 'the timers of their rates'
    return 'the answers' if kinds <= {WaitKind.ANSWER} else 'what ends the waits'


def _hit(waits: Sequence[Wait], capacity: Capacity, rest: str, severity: Severity | None) -> Hit:
    asked = [each for each in capacity.together if each.askers and each.count == 1]
    runs = 'run' if asked and len(capacity.together) < capacity.at_least else 'callback'
    names = _counted(capacity)
    return Hit(
        place=_first(waits, capacity).place,
        message=f'{plural(capacity.at_least, runs)} can wait at the same time ({names}) {rest}',
        help=_help(capacity),
        severity=severity,
        subjects=tuple(callback.name for callback in capacity.together),
        chain=_first(waits, capacity).chain,
        related=(*_others(waits, capacity), *_asked(capacity)),
    )


def _counted(capacity: Capacity) -> str:
    """Name those that can wait together, and how often each that is there several times."""
    times: Counter[str] = Counter()
    for callback, number in zip(capacity.together, capacity.times, strict=True):
        times[called(callback)] += number
    return listing(name if n == 1 else f'{name} {n} times' for name, n in times.items())


def _asked(capacity: Capacity) -> Iterator[Remark]:
    for service in capacity.together:
        if service.askers and service.source is not None:
            words = f'{plural(service.askers, "known client")} may ask {called(service)} at once'
            yield Remark(service.source, words)


def _help(capacity: Capacity) -> str:
    if not capacity.unbounded:
        return f'{capacity.at_least + 1} threads are the smallest number that is enough'
    return (
        f'at least {capacity.at_least + 1} threads, but no number is certainly enough: '
        f'{shown(capacity.unbounded)} may also overlap {_itself(capacity.unbounded)}; '
        f'{_remedy(capacity.unbounded)}'
    )


def _itself(unbounded: Sequence[Callback]) -> str:
    return 'itself' if len(unbounded) == 1 else 'themselves'


def _remedy(unbounded: Sequence[Callback]) -> str:
    """What keeps callbacks from overlapping themselves; work in no group cannot be put in one."""
    members = [c for c in unbounded if not c.groupless]
    outside = dict.fromkeys(
        _OUTSIDE.get(c.entity or EntityKind.TASK, _TASK) for c in unbounded if c.groupless
    )
    it = 'it' if len(members) == 1 else 'each of them'
    who = it if not outside else shown(members)
    ways = [f'put {who} into a mutually exclusive group of its own'] if members else []
    return '; '.join((*ways, *outside))


def _overlap_hit(waits: Sequence[Wait], capacity: Capacity, workers: Workers) -> Hit:
    """Answers may come in time; the timer of a rate never comes before its period."""
    of_unbounded = [wait for wait in waits if wait.caller in capacity.unbounded]
    first = next((w for w in of_unbounded if w.kind is WaitKind.RATE), of_unbounded[0])
    is_rate = first.kind is WaitKind.RATE
    comes_by_itself = first.caller.entity in (EntityKind.SUBSCRIPTION, EntityKind.TIMER)
    who = f'{shown(capacity.unbounded)} may overlap {_itself(capacity.unbounded)}'
    runs, threads = 'as many runs as the machine has CPUs', 'threads'
    if not workers.is_default:
        runs, threads = plural(workers.count, 'run'), plural(workers.count, 'thread')
    when = 'in Rate.sleep; ' if is_rate else 'in a wait; when answers are slow, '
    return Hit(
        place=first.place,
        message=f'{who} {when}{runs} can hold all {threads}, and no thread is left for '
        f'{_awaited([first])}',
        help=f'{_remedy(capacity.unbounded)}; then {plural(capacity.at_least + 1, "thread")} are '
        'enough',
        severity=Severity.WARNING if is_rate and comes_by_itself else Severity.NOTE,
        subjects=tuple(callback.name for callback in capacity.unbounded),
        chain=first.chain,
        related=_others([first], capacity),
    )


def _first(waits: Sequence[Wait], capacity: Capacity) -> Wait:
    return next(wait for wait in waits if wait.caller in capacity.together)


def _others(waits: Sequence[Wait], capacity: Capacity) -> tuple[Remark, ...]:
    first = _first(waits, capacity) if waits[0].caller in capacity.together else waits[0]
    return tuple(
        Remark(wait.place, f'{wait.caller.display_name} waits here in {wait.block.call}')
        for wait in waits
        if wait is not first and wait.caller in capacity.together
    )


RULE = Rule(
    code='CC103',
    slug='pool-exhausted',
    severity=Severity.ERROR,
    title='Every worker thread may wait at once',
    what='As many callbacks can wait synchronously at the same time as the executor has worker '
    'threads. Their groups are right, but no thread is left to run what they wait for. The '
    'number is exact: a mutually exclusive group counts once, a reentrant callback counts by '
    'itself, and of alternative branches only one counts. That a callback may also overlap '
    'itself is a note. It is a warning for a subscription or timer that sleeps by a `Rate`, '
    'since each run sleeps for a period, and for a service that waits without a time-out where '
    'the model has a run in which all threads are taken by one arrival for each callback. A '
    'service of a reentrant group counts as often as known clients may call it at the same '
    'time, on any executor. If it takes more requests than these, it stays a note, and the run '
    'is shown. A callback that claims a state under a lock, waits, and releases it is not '
    'reported. Loops that sleep and then check whether another callback has written something '
    'take threads too, even if they can end otherwise: a warning.',
    why='A `MultiThreadedExecutor` runs callbacks in a pool of `num_threads` workers; answers '
    'are handled by the same workers, and the spinning thread runs no callbacks. Without '
    '`num_threads` the pool has one worker for each CPU, so the same node works on one machine '
    'and hangs on another. In a reentrant group a callback may start again before its last run '
    'has ended. Sources: rclpy 7.1.6 and 9.1.2, `executors.py` (`MultiThreadedExecutor`, '
    '`_make_handler`). Measured: 4 reentrant callers, 0 completed calls on 4 threads, 64 of 64 '
    'on 8; a reentrant timer of 10 Hz that sleeps by a rate of 2 Hz on 4 threads: no sleep ends.',
    bad="""\
class Arms(Node):
    def __init__(self):
        super().__init__('arms')
        for name, callback in (('left', self.left), ('right', self.right)):
            group = MutuallyExclusiveCallbackGroup()
            self.create_timer(0.5, callback, callback_group=group)
    # left and right each call a service synchronously

executor = MultiThreadedExecutor(num_threads=2)
""",
    good="""\
executor = MultiThreadedExecutor(num_threads=3)  # two may wait, the third takes the answers
""",
    mend='Raise `num_threads` above the number of callbacks that can wait at once, always by an '
    'explicit number; put callers into mutually exclusive groups, so that none overlaps itself '
    '(an execute callback is in no group: accept one goal at a time in `goal_callback`); '
    'or do not wait in callbacks at all.',
    find=find,
)
