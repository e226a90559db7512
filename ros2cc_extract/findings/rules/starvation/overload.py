"""CC208: more work than a thread has time for, so that others run less often than they are due."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import listing, made_at, shown
from ros2cc_extract.findings.rules.starvation import group_overload, long_sleep
from ros2cc_extract.findings.rules.starvation.group_overload import asks, place_of
from ros2cc_extract.spec.effects import OUTSIDE, PAUSES, Blocking
from ros2cc_extract.spec.model import Callback, Spec
from ros2cc_extract.verify.results.load import Load, LoadKind, Serving, demands_of, load_of
from ros2cc_extract.verify.results.rates import Demand, least_slept_s

MOST_RUNS = 0.9
"""A callback with this share of its runs, or more, is served well enough: our choice."""
_SLEEP = 'time.sleep'
_LATE = (LoadKind.DEGRADED, LoadKind.STARVED)


def find(context: Context) -> Iterator[Hit]:
    """One finding for those that together ask for too much, unless another rule reports them."""
    reported = {name for hit in _reported_hits(context) for name in hit.subjects}
    for hit in _hits(context, context.unit, (LoadKind.DEGRADED,)):
        if reported.isdisjoint(hit.subjects):
            reported |= set(hit.subjects)
            yield hit
    for hit in _hits(context, _with_branches(context.unit), _LATE):
        if reported.isdisjoint(hit.subjects):
            busy = [context.by_name[name] for name in hit.subjects]
            # One that waits for nothing but its own next message or byte does no harm.
            if hit.severity is None or not _open_waits(busy):
                yield _of_branches(hit, busy)


def _open_waits(busy: Sequence[Callback]) -> list[Blocking]:
    longest = [_longest_open(callback) for callback in busy]
    return [each for each in longest if each is not None and each.call not in PAUSES]


def _of_branches(hit: Hit, busy: Sequence[Callback]) -> Hit:
    """A note at the sleep, or at the wait with a time-out, that makes the difference."""
    waits = _open_waits(busy)
    when = 'while its runs come to this sleep'
    if waits:
        calls = dict.fromkeys(each.call for each in waits)
        when = f'while nothing comes within the time-out of {listing(calls)}'
        hit = replace(hit, place=waits[-1].source or hit.place)
    return replace(hit, message=f'{hit.message}; so it is {when}', severity=Severity.NOTE)


def _hits(context: Context, unit: Spec, late: Collection[LoadKind]) -> Iterator[Hit]:
    demands = demands_of(unit)
    victims: dict[tuple[str, ...], list[tuple[Callback, Load]]] = {}
    written = {callback.name for callback in context.written}
    for callback in unit.callbacks:
        load = load_of(unit, callback, demands)
        is_late = load.kind in late and load.runs is not None and load.runs <= MOST_RUNS
        if callback.name in written and is_late:
            victims.setdefault(_heaviest(load.busy, demands), []).append((callback, load))
    by_name = {callback.name: callback for callback in unit.callbacks}
    for names, kept in victims.items():
        others = [(callback, load) for callback, load in kept if callback.name not in names]
        hit = _hit([by_name[name] for name in names], others or kept, unit)
        yield hit if others else replace(hit, severity=Severity.NOTE)


def _with_branches(unit: Spec) -> Spec:
    """
    The unit as it is while each callback comes to the longest sleep that a branch may skip.

    A wait for a device or another program is one while nothing comes.
    """
    return replace(unit, callbacks=tuple(map(_as_if_taken, unit.callbacks)))


def _as_if_taken(callback: Callback) -> Callback:
    longest = _longest_open(callback)
    if longest is None:
        return callback
    blocking = (_taken(block) if block is longest else block for block in callback.blocking)
    return replace(callback, blocking=tuple(blocking))


def _longest_open(callback: Callback) -> Blocking | None:
    waits = [b for b in callback.blocking if b.conditional or _is_of_others(b)]
    return max(waits, key=lambda block: least_slept_s([_taken(block)]), default=None)


def _is_of_others(block: Blocking) -> bool:
    is_outside = bool(block.wakers) and all(waker.by == OUTSIDE for waker in block.wakers)
    return is_outside and isinstance(block.seconds, (int, float)) and not block.suspends


def _taken(block: Blocking) -> Blocking:
    call = _SLEEP if _is_of_others(block) else block.call
    return replace(block, call=call, conditional=False)


def _reported_hits(context: Context) -> Iterator[Hit]:
    yield from long_sleep.find(context)
    yield from group_overload.find(context)


def _heaviest(busy: Sequence[str], demands: Mapping[str, Demand]) -> tuple[str, ...]:
    """The one that has no time for itself, or else all that together have not."""
    alone = [name for name in busy if demands[name].load >= 1]
    worst = max(alone, key=lambda name: demands[name].load, default=None)
    return tuple(busy) if worst is None else (worst,)


def _hit(busy: Sequence[Callback], victims: Sequence[tuple[Callback, Load]], unit: Spec) -> Hit:
    callbacks = [callback for callback, _ in victims]
    load = min((load for _, load in victims), key=lambda load: load.runs or 0.0)
    run = 'runs' if len(victims) == 1 else 'run'
    least = 'about' if len(victims) == 1 else 'down to about'
    return Hit(
        place=place_of(busy[-1]),
        message=f'{shown(busy)} {asks(busy, load, unit)}, more than '
        f'{_where(load, busy[-1], unit)} has time for: {shown(callbacks)} {run} {least} '
        f'{load.runs:.0%} as often as due',
        help='give it a period longer than its work, or a group of its own on a '
        'MultiThreadedExecutor',
        subjects=tuple(callback.name for callback in busy),
        related=tuple(made_at(*dict.fromkeys((*busy, *callbacks)))),
    )


def _where(load: Load, busy: Callback, unit: Spec) -> str:
    if load.serving is Serving.LEFTOVER:
        return unit.group_of(busy).display_name
    executor = unit.executor
    if load.serving is Serving.POOL:
        return f'a pool of {len(executor.threads)} threads'
    return f'the only thread of the {executor.kind}'


RULE = Rule(
    code='CC208',
    slug='overload',
    severity=Severity.WARNING,
    title='Work that takes longer than its period',
    what='A timer callback sleeps for longer than its period, or several together ask for more '
    'time than their thread, their mutually exclusive group or their pool has. Others that are '
    'served there run less often than they are due: messages pile up and get lost, timers miss '
    'periods. Periods and durations are those of `verify --profile rclpy`: written by hand, '
    'measured in a run, or read from timers and sleeps in the source, which only make it worse '
    'where more is done. A sleep that a branch may skip gives a note: so it is while the runs '
    'come to it; so does a wait with a time-out for a device or another program, for which '
    'nothing may come; so does one by which nobody else is late. A single long sleep is CC201, a '
    'callback that never runs CC202.',
    why='One thread serves in turns all that is ready: the slowest sets the pace. Source: rclpy '
    '7.1.6 and 9.1.2, `executors.py` (`_wait_for_ready_callbacks`). Measured on both: a timer '
    'that has missed several periods runs once for them; and of one of 0.05 s, on one thread '
    'beside one of 0.1 s that sleeps 0.2 s, there were 51 and 50 runs in 10 s instead of 200.',
    bad="""\
class Detector(Node):
    def __init__(self):
        super().__init__('detector')
        self.create_timer(0.05, self.beat)
        self.create_timer(0.1, self.detect)     # sleeps 0.2 s

rclpy.spin(Detector())
""",
    good="""\
class Detector(Node):
    def __init__(self):
        super().__init__('detector')
        self.create_timer(0.05, self.beat)
        self.create_timer(0.5, self.detect)

rclpy.spin(Detector())
""",
    mend='Give it a period longer than its work, or a group of its own on a '
    '`MultiThreadedExecutor`.',
    find=find,
)
