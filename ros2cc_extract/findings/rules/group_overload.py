"""CC202: timers that sleep longer than their period, alone or together in one group."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.rule import Context, Hit, Rule
from ros2cc_extract.findings.waits import WaitKind, kind_of
from ros2cc_extract.findings.words import group_words, made_at, shown
from ros2cc_extract.findings.workers import MULTI
from ros2cc_extract.places import Place
from ros2cc_extract.spec.model import Callback, CallbackGroup, EntityKind

SERVING_ORDER = (
    EntityKind.TIMER,
    EntityKind.SUBSCRIPTION,
    EntityKind.GUARD_CONDITION,
    EntityKind.CLIENT,
    EntityKind.SERVICE,
)
"""Kinds in the order in which one node's ready entities are served, each in creation order."""


def find(context: Context) -> Iterator[Hit]:
    """Only where one starved group member is certain: a multi-threaded executor, one group."""
    if context.unit.executor.kind != MULTI:
        return
    for group in context.unit.groups:
        members = [c for c in context.written if c.group == group.name]
        if members and context.exclusive_group(members[0]) is not None:
            yield from _overloaded(group, members)


def _overloaded(group: CallbackGroup, members: list[Callback]) -> Iterator[Hit]:
    served = sorted(members, key=_rank)
    load = 0.0
    for number, callback in enumerate(served):
        load += load_of(callback)
        victims = served[number + 1 :]
        if load >= 1 and victims and len({c.node for c in members}) == 1:
            yield _hit(group, served[: number + 1], victims, load)
            return


def load_of(callback: Callback) -> float:
    """Share of the time for which a timer sleeps; 0 for what is not known or conditional."""
    if callback.entity is not EntityKind.TIMER or callback.conditional or callback.one_shot:
        return 0.0
    period = callback.period_s
    if not isinstance(period, float) or period <= 0:
        return 0.0
    slept = (b.seconds for b in callback.blocking if kind_of(b) is WaitKind.SLEEP)
    return sum(s for s in slept if isinstance(s, float)) / period


def _rank(callback: Callback) -> int:
    known = callback.entity in SERVING_ORDER
    return SERVING_ORDER.index(callback.entity) if known and callback.entity else -1


def _hit(group: CallbackGroup, busy: list[Callback], victims: list[Callback], load: float) -> Hit:
    last = next(c for c in reversed(busy) if load_of(c) > 0)
    sleep = next(b for b in last.blocking if kind_of(b) is WaitKind.SLEEP)
    sleepers = [c for c in busy if load_of(c) > 0]
    return Hit(
        place=sleep.source or last.defined or last.source or Place(last.name),
        message=f'{shown(sleepers)} in {group_words(group)} '
        f'{"sleeps" if len(sleepers) == 1 else "sleep"} {load:.0%} of the time: '
        f'whenever the group opens {"it" if len(sleepers) == 1 else "one of them"} is due, so '
        f'{shown(victims)}, served after {"it" if len(sleepers) == 1 else "them"}, '
        'may never run',
        help='give the timer that sleeps a group of its own, or a period longer than its work; '
        'within a group the order of creation decides who starves',
        subjects=(group.name, *(c.name for c in sleepers)),
        related=tuple(made_at(*sleepers, *victims)),
    )


RULE = Rule(
    code='CC202',
    slug='group-overload',
    severity=Severity.WARNING,
    title='Group kept busy by timers that are served first',
    what='The timers of a mutually exclusive group sleep at least as long as their periods '
    'allow, so that one of them is always due when the group opens. Members that are served '
    'after them never get a turn on a multi-threaded executor.',
    why='After each end the executor looks again from the start: timers first, then '
    'subscriptions, guard conditions, clients and services, each in order of creation. Source: '
    'rclpy 7.1.6 and 9.1.2, `executors.py` (`_wait_for_ready_callbacks`). Measured for two '
    'timers of one group: at a load of 0.9 both run 40 times, at 1.2 one 39 and the other 26 '
    'times, at 2.1 the second never.',
    bad="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.read_camera)   # sleeps 0.2 s
        self.create_subscription(Empty, 'stop', self.on_stop, 10)

executor = MultiThreadedExecutor(num_threads=4)
""",
    good="""\
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.read_camera,
                          callback_group=MutuallyExclusiveCallbackGroup())
        self.create_subscription(Empty, 'stop', self.on_stop, 10)
""",
    mend='Give the busy timer a group of its own, or a period longer than its work.',
    find=find,
)
