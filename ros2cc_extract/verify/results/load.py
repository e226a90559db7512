"""
How busy those are that a callback has to wait for: starvation judged by periods and durations.

The models know no times: they say whether a callback *may* be kept from running forever. Here the
rates decide. Source of the rules: measured on rclpy 7.1.6 and 9.1.2 (docs/profile-rclpy.md,
*Times*): on several threads an exclusive group starts over from its first member after each
end, so a member gets what those served before it leave; one thread serves all in turns.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from enum import Enum
from math import ceil

from ros2cc_extract.generator.executor_kinds import ExecutorKind, executor_kind, rank_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.model import Callback, GroupType, Spec
from ros2cc_extract.verify.results.rates import Demand, demand_of

#: Serving takes time too: a busy node measures a load a little below 1 of itself.
SERVING = 0.05
SATURATED_AS_MEASURED = 1 - SERVING
#: A victim is collected and refused again and again; others are refused now and then.
REFUSED_PER_RUN = 10
REFUSED_AT_LEAST = 5


class LoadKind(Enum):
    """What becomes of a callback at the rates given."""

    STARVED = 'starved'
    DEGRADED = 'degraded'
    FINE = 'fine at these rates'
    UNDECIDED = 'not decided without times'
    UNKNOWN = 'possible under overload; rates unknown'


class Serving(Enum):
    """How a callback gets its turn."""

    LEFTOVER = 'what the members served before it leave of its group'
    TURNS = 'one thread serves all in turns'
    POOL = 'threads serve in the order of submission'


@dataclass(frozen=True, kw_only=True)
class Load:
    """
    What becomes of one callback.

    :param before: share of the time for which those served before it run; of all on one thread,
        and of the threads taken together in a pool.
    :param own: share of the time for which it wants to run; ``None`` where that is unknown.
    :param runs: share of its arrivals that it gets to serve; ``None`` where that is unknown.
    :param busy: names of the callbacks counted in ``before``, in serving order.
    :param unknown: names of those whose period or duration is not known.
    :param refused: how a run has seen it starve, in words.
    :param contenders: how many may want a thread at a time, where that leaves it undecided.
    :param slow: ``before`` while all runs are slow ones; ``None`` where none was measured. Else
        ``before`` is of medians.
    """

    callback: str
    kind: LoadKind
    serving: Serving
    before: float
    own: float | None
    runs: float | None
    busy: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()
    refused: str | None = None
    slow: float | None = None
    contenders: int = 0

    @property
    def words(self) -> str:
        """The short words beside a verdict on starvation."""
        if self.kind is LoadKind.UNKNOWN:
            can_starve = self.serving is Serving.LEFTOVER
            return self.kind.value if can_starve else 'delayed under overload; rates unknown'
        start = f'{self.kind.value} (load {self.before:.2f}{self._measured}'
        if self.refused is not None:
            return f'{start}; {self.refused})'
        if self.kind is LoadKind.UNDECIDED:
            return f'{start}; {self.contenders} may want a thread at a time, and there are fewer)'
        if self.kind is LoadKind.STARVED or self.runs is None or self.runs >= 1:
            return f'{start})'
        return f'{start}; about {self.runs:.0%} of its arrivals are served)'

    @property
    def _measured(self) -> str:
        if self.slow is None:
            return ''
        slow, median = f'{self.slow:.2f}', f'{self.before:.2f}'
        return ' by medians' if slow == median else f' by medians, {slow} in slow runs'


def load_of(spec: Spec, callback: Callback, demands: Mapping[str, Demand] | None = None) -> Load:
    """
    Return what becomes of ``callback`` at the rates that ``spec`` states or a run has measured.

    :param demands: of ``demands_of``, where several are asked for.
    """
    counted = {c.name: c for c in (*_counted(spec), callback)}
    known = demands_of(spec) if demands is None else demands
    demands = {name: known[name] for name in counted}
    if _is_one_thread(spec):
        return _in_turns(spec, callback, demands)
    in_pool = _in_pool(spec, callback, demands)
    group = spec.group_of(callback)
    if group.type is not GroupType.EXCLUSIVE or group.groupless or callback.groupless:
        return in_pool
    in_group = _of_leftover(spec, callback, demands)
    contenders = _contenders(spec, demands)
    waits_in_queue = contenders > len(spec.executor.threads) and served_before(callback, spec)
    if waits_in_queue and in_group.kind in (LoadKind.FINE, LoadKind.DEGRADED):
        return replace(in_group, kind=LoadKind.UNDECIDED, runs=None, contenders=contenders)
    crowded = in_pool.kind is LoadKind.DEGRADED and in_group.kind is LoadKind.FINE
    return in_pool if crowded else in_group


def _contenders(spec: Spec, demands: Mapping[str, Demand]) -> int:
    """
    Count the callbacks that may want a thread at the same time.

    With more of them than threads, members of one group wait in the queue together, and which is
    served later may be refused each time, below full load too (H. Teper et al., EMSOFT 2024; seen
    on rclpy 7.1.6: two threads, three groups, a member with 1 % of the work of the others never
    ran). Only the times of all of them show which it is.
    """
    exclusive = {g.name for g in spec.groups if g.type is GroupType.EXCLUSIVE}
    counted = _counted(spec)
    others = [demands[c.name].load for c in counted if c.group not in exclusive]
    return len({c.group for c in counted} & exclusive) + sum(max(1, ceil(x)) for x in others)


def demands_of(spec: Spec, others: Sequence[Spec] = ()) -> dict[str, Demand]:
    """
    What each callback asks for.

    :param others: units that run beside this one: timers there may publish what arrives here.
    """
    return {callback.name: demand_of(callback, (spec, *others)) for callback in spec.callbacks}


def served_before(callback: Callback, spec: Spec) -> tuple[Callback, ...]:
    """
    Members of its group that are served before a callback, in serving order.

    Nodes are served in any order, so those of another node count too.
    """
    places = {each.name: place for place, each in enumerate(spec.callbacks)}

    def order(one: Callback) -> tuple[int, int]:
        return rank_of(one), places[one.name]

    members = [c for c in _counted(spec) if c.group == callback.group and c != callback]
    before = (c for c in members if order(c) < order(callback) or c.node != callback.node)
    return tuple(sorted(before, key=order))


def _counted(spec: Spec) -> list[Callback]:
    """Without rclpy's own entities: they are seldom asked, unless a run has measured it."""
    return [c for c in spec.callbacks if not c.builtin or c.measured is not None]


def _is_one_thread(spec: Spec) -> bool:
    """A pool of one worker refuses nothing: what is queued runs next."""
    kind = executor_kind(spec)
    return kind is not ExecutorKind.MULTI_THREADED or len(spec.executor.threads) == 1


def _of_leftover(spec: Spec, callback: Callback, demands: Mapping[str, Demand]) -> Load:
    earlier = served_before(callback, spec)
    busy = [demands[c.name] for c in earlier]
    before = sum(demand.load for demand in busy)
    own = demands[callback.name]
    full = SATURATED_AS_MEASURED if any(d.is_rate_measured for d in busy) else 1.0
    left = max(0.0, 1 - before)
    wanted = _wanted(own, before)
    refused = _refusals(callback)
    if before >= full or refused is not None:
        kind = LoadKind.STARVED
    elif left < _fair_share(wanted, busy) - SERVING:
        # Durations that are only known from below make it worse, never better.
        kind = LoadKind.DEGRADED if own.load else LoadKind.UNKNOWN
    else:
        known = all(demand.is_known for demand in busy)
        kind = LoadKind.FINE if known else LoadKind.UNKNOWN
    runs = {LoadKind.STARVED: 0.0, LoadKind.UNKNOWN: None}.get(
        kind, min(1.0, left / own.load) if own.load else None
    )
    return Load(
        callback=callback.name,
        kind=kind,
        serving=Serving.LEFTOVER,
        before=before,
        own=own.load if own.is_known else None,
        runs=runs,
        busy=tuple(c.name for c in earlier if demands[c.name].load > 0),
        unknown=_unknown((*earlier, callback), demands),
        refused=refused,
        slow=_slow(busy, sum(demand.slow_load for demand in busy)),
    )


def _refusals(callback: Callback) -> str | None:
    """Say how a run has seen a member starve: something was there for it, and others ran."""
    seen = callback.measured
    least = max(REFUSED_AT_LEAST, REFUSED_PER_RUN * seen.count) if seen else 0
    if seen is None or seen.refused < least:
        return None
    return f'in a run it was refused {seen.refused} times and ran {seen.count} times'


def _wanted(own: Demand, before: float) -> float:
    """What it asks for; runs of a busy node show how often it ran, not how often it should."""
    if not own.is_known:
        return 1.0
    was_busy = own.is_rate_measured and before + own.load >= SATURATED_AS_MEASURED
    return 1.0 if was_busy else own.load


def _fair_share(wanted: float, others: Sequence[Demand]) -> float:
    """What it would get of the group if all had equal priority; at most what it wants."""
    rest, sharers = 1.0, len(others) + 1
    for load in sorted(other.load for other in others):
        if load >= rest / sharers:
            break
        rest, sharers = rest - load, sharers - 1
    return min(wanted, rest / sharers)


def _in_turns(spec: Spec, callback: Callback, demands: Mapping[str, Demand]) -> Load:
    total = sum(demand.load for demand in demands.values())
    own = demands[callback.name]
    unknown = _unknown(_counted(spec), demands)
    runs = min(1.0, own.period_s / _lap_s(demands)) if own.period_s and total > 1 else 1.0
    kind = LoadKind.DEGRADED if runs < 1 else LoadKind.UNKNOWN if unknown else LoadKind.FINE
    return Load(
        callback=callback.name,
        kind=kind,
        serving=Serving.TURNS,
        before=total,
        own=own.load if own.is_known else None,
        runs=None if kind is LoadKind.UNKNOWN else runs,
        busy=tuple(name for name, demand in demands.items() if demand.load > 0),
        unknown=unknown,
        slow=_slow(demands.values(), sum(demand.slow_load for demand in demands.values())),
    )


def _slow(demands: Iterable[Demand], load: float) -> float | None:
    return load if any(demand.slow_s is not None for demand in demands) else None


def _lap_s(demands: Mapping[str, Demand]) -> float:
    """
    How long one lap over all that is ready takes under overload.

    In a lap of T seconds a callback of period p and duration d runs min(1, T/p) times, so T is
    the sum of d * min(1, T/p): those that are ready in every lap share what the others leave.
    """
    timed = [d for d in demands.values() if d.period_s and d.duration_s]
    lap = sum(d.duration_s or 0.0 for d in timed)
    for _ in timed:
        always = sum(d.duration_s or 0.0 for d in timed if (d.period_s or 0.0) <= lap)
        others = sum(d.load for d in timed if (d.period_s or 0.0) > lap)
        lap = always / (1 - others) if others < 1 else lap
    return lap


def _in_pool(spec: Spec, callback: Callback, demands: Mapping[str, Demand]) -> Load:
    threads = len(spec.executor.threads)
    total = _of_groups(spec, {name: demand.load for name, demand in demands.items()})
    slow = _of_groups(spec, {name: demand.slow_load for name, demand in demands.items()})
    own = demands[callback.name]
    unknown = _unknown(_counted(spec), demands)
    crowded = total > threads
    kind = LoadKind.DEGRADED if crowded else LoadKind.UNKNOWN if unknown else LoadKind.FINE
    return Load(
        callback=callback.name,
        kind=kind,
        serving=Serving.POOL,
        before=total / threads,
        own=own.load if own.is_known else None,
        runs=threads / total if crowded else None if unknown else 1.0,
        busy=tuple(name for name, demand in demands.items() if demand.load > 0),
        unknown=unknown,
        slow=_slow(demands.values(), slow / threads),
    )


def _of_groups(spec: Spec, loads: Mapping[str, float]) -> float:
    """How many threads they want; an exclusive group never wants more than one."""
    total = 0.0
    by_group: dict[str, float] = {}
    for callback in _counted(spec):
        by_group[callback.group] = by_group.get(callback.group, 0.0) + loads[callback.name]
    for group in spec.groups:
        wanted = by_group.get(group.name, 0.0)
        total += min(1.0, wanted) if group.type is GroupType.EXCLUSIVE else wanted
    return total


def _unknown(callbacks: Sequence[Callback], demands: Mapping[str, Demand]) -> tuple[str, ...]:
    return tuple(c.name for c in callbacks if not demands[c.name].is_known)
