"""CC202: members of one group that leave no time to those that are served after them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.rule import Context, Hit, Rule
from ros2cc_extract.findings.base.wording import made_at, shown
from ros2cc_extract.findings.waits.waits import WaitKind, kind_of
from ros2cc_extract.findings.waits.workers import MULTI
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Callback, CallbackGroup, Spec
from ros2cc_extract.spec.releases.table import POOL_ORDER_VARIES
from ros2cc_extract.verify.results.load import Load, LoadKind, load_of, served_before
from ros2cc_extract.verify.results.rates import demand_of


def find(context: Context) -> Iterator[Hit]:
    """Only where one starved member is certain: several nodes are served in any order."""
    if context.unit.executor.kind != MULTI:
        return
    for group in context.unit.groups:
        members = [c for c in context.written if c.group == group.name]
        is_exclusive = bool(members) and context.exclusive_group(members[0]) is not None
        if is_exclusive and len({c.node for c in members}) == 1:
            yield from _overloaded(group, members, context)


def _overloaded(
    group: CallbackGroup, members: Sequence[Callback], context: Context
) -> Iterator[Hit]:
    unit = context.unit
    loads = {callback.name: load_of(unit, callback) for callback in members}
    starved = {n: load for n, load in loads.items() if load.kind is LoadKind.STARVED and load.busy}
    victims = [c for c in members if c.name in starved]
    victims.sort(key=lambda victim: len(served_before(victim, unit)))
    if victims:
        load = starved[victims[0].name]
        busy = [context.by_name[name] for name in load.busy]
        yield _hit(group, busy, victims, load, unit)


def _hit(
    group: CallbackGroup,
    busy: Sequence[Callback],
    victims: Sequence[Callback],
    load: Load,
    unit: Spec,
) -> Hit:
    it = 'it' if len(busy) == 1 else 'one of them'
    return Hit(
        place=place_of(busy[-1]),
        message=f'{shown(busy)} in {group.display_name} {asks(busy, load, unit)}: whenever the '
        f'group opens {it} is due, so {shown(victims)}, served after '
        f'{"it" if len(busy) == 1 else "them"}, may never run',
        help='give what keeps the group busy a group of its own, or a period longer than its '
        'work; within a group the order of creation decides which one starves',
        subjects=(group.name, *(c.name for c in busy)),
        related=tuple(made_at(*busy, *victims)),
    )


def asks(busy: Sequence[Callback], load: Load, unit: Spec) -> str:
    """Say how much of the time they want."""
    if len(busy) > 1:
        return f'together ask for {load.before:.0%} of the time'
    demand = demand_of(busy[0], [unit])
    least = 'at least ' if demand.is_least else ''
    return f'takes {least}{demand.duration_s:g} s and is due every {demand.period_s:g} s'


def place_of(callback: Callback) -> Place:
    """Where it sleeps, or else where it stands."""
    sleeps = (b.source for b in callback.blocking if kind_of(b) is WaitKind.SLEEP)
    slept = next((place for place in sleeps if place is not None), None)
    return slept or callback.defined or callback.source or Place(callback.name)


RULE = Rule(
    code='CC202',
    slug='group-overload',
    severity=Severity.WARNING,
    title='Group kept busy by callbacks that are served first',
    what='Callbacks of a mutually exclusive group take at least as long as their periods allow, '
    'so one of them is always due when the group opens. Members that are served after them never '
    'get a turn on a multi-threaded executor (with Python 3.13 and later: hardly ever). Periods '
    'and durations are those of `verify --profile rclpy`: written by hand, measured in a run, or '
    'read from timers and sleeps in the source; for a subscription, those of the one timer that '
    'publishes for it, in any program of the sources.',
    why='After each end the executor looks again from the start: timers first, then '
    'subscriptions, guard conditions, clients and services, each in order of creation. Source: '
    'rclpy 7.1.6 and 9.1.2, `executors.py` (`_wait_for_ready_callbacks`). Measured for two '
    'timers of one group: at a load of 0.9 both run 40 times, at 1.2 one 39 and the other 26 '
    'times, at 2.1 the second never (Python 3.11 and 3.12). From Python 3.13 on two threads of a '
    f'pool begin what they were given {POOL_ORDER_VARIES.having}. Measured: '
    f'{POOL_ORDER_VARIES.observed}.',
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
