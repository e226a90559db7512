"""CC208: more work than a thread has time for, so that others run less often than they are due."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, shown
from ros2cc_extract.findings.rules.starvation import group_overload, long_sleep
from ros2cc_extract.findings.rules.starvation.group_overload import asks, place_of
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.verify.results.load import Load, LoadKind, Serving, demands_of, load_of
from ros2cc_extract.verify.results.rates import Demand

MOST_RUNS = 0.9
"""A callback with this share of its runs, or more, is served well enough: our choice."""


def find(context: Context) -> Iterator[Hit]:
    """One finding for those that together ask for too much, unless another rule reports them."""
    demands = demands_of(context.unit)
    victims: dict[tuple[str, ...], list[tuple[Callback, Load]]] = {}
    for callback in context.written:
        load = load_of(context.unit, callback, demands)
        if load.kind is LoadKind.DEGRADED and load.runs is not None and load.runs <= MOST_RUNS:
            victims.setdefault(_heaviest(load.busy, demands), []).append((callback, load))
    reported = {name for hit in _reported_hits(context) for name in hit.subjects}
    for names, kept in victims.items():
        busy = [context.by_name[name] for name in names]
        others = [(callback, load) for callback, load in kept if callback.name not in names]
        if others and reported.isdisjoint(names):
            yield _hit(busy, others, context)


def _reported_hits(context: Context) -> Iterator[Hit]:
    yield from long_sleep.find(context)
    yield from group_overload.find(context)


def _heaviest(busy: Sequence[str], demands: Mapping[str, Demand]) -> tuple[str, ...]:
    """The one that has no time for itself, or else all that together have not."""
    alone = [name for name in busy if demands[name].load >= 1]
    worst = max(alone, key=lambda name: demands[name].load, default=None)
    return tuple(busy) if worst is None else (worst,)


def _hit(
    busy: Sequence[Callback], victims: Sequence[tuple[Callback, Load]], context: Context
) -> Hit:
    callbacks = [callback for callback, _ in victims]
    load = min((load for _, load in victims), key=lambda load: load.runs or 0.0)
    run = 'runs' if len(victims) == 1 else 'run'
    least = 'about' if len(victims) == 1 else 'down to about'
    return Hit(
        place=place_of(busy[-1]),
        message=f'{shown(busy)} {asks(busy, load, context.unit)}, more than '
        f'{_where(load, busy[-1], context)} has time for: {shown(callbacks)} {run} {least} '
        f'{load.runs:.0%} as often as due',
        help='give it a period longer than its work, or a group of its own on a '
        'MultiThreadedExecutor',
        subjects=tuple(callback.name for callback in busy),
        related=tuple(made_at(*busy, *callbacks)),
    )


def _where(load: Load, busy: Callback, context: Context) -> str:
    if load.serving is Serving.LEFTOVER:
        return context.unit.group_of(busy).display_name
    executor = context.unit.executor
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
    'where more is done. Sleeps behind a branch do not count. A single long sleep is CC201, a '
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
