"""
Who waits for whom, and whether any of it can still end: the wait-for graph of one process.

What may end a wait is taken too wide rather than too narrow: an event may be set by any callback
that can still be served and by any thread that still moves. So what is called a deadlock has
nobody left, and what is not decided is said to be so. Source of who can be served: rclpy 7.1.6
and 9.1.2, ``Executor.can_execute`` and ``_make_handler``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from enum import Enum

from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, Wait, locks_held, wait_of
from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Entity, Executor, Look

_BY_ANYBODY = (Kind.EVENT, Kind.CONDITION, Kind.QUEUE, Kind.FUTURE, Kind.ACTION)
_OWN_BUSINESS = (Kind.EVENT, Kind.CONDITION, Kind.QUEUE, Kind.WORK, Kind.FUTURE, Kind.JOIN)


class Verdict(Enum):
    """What the process does, in one word."""

    DEADLOCK = 'deadlock'
    NOBODY_SPINS = 'nobody spins'
    OUTSIDE = 'waits for another process'
    UNDECIDED = 'undecided'
    BUSY = 'busy'
    HEALTHY = 'idle and healthy'


@dataclass(frozen=True)
class Standing:
    """
    One activity and what it waits for.

    :param moved: it was elsewhere at the other look.
    :param can_end: something is left that can end its wait.
    :param waits_for: what keeps the wait from its end, in words.
    :param code: of the rule that finds such a wait in sources.
    """

    activity: Activity
    wait: Wait
    moved: bool
    can_end: bool
    waits_for: tuple[str, ...] = ()
    code: str | None = None

    @property
    def in_callback(self) -> bool:
        return bool(self.activity.entities)


@dataclass(frozen=True)
class Explanation:
    verdict: Verdict
    standings: tuple[Standing, ...]
    look: Look


def explain(before: Look, after: Look) -> Explanation:
    """
    Judge by two looks; only what stands still, and has nobody left, in both counts.

    One look is no instant: the frames are read some milliseconds before the groups.
    """
    first, graph = _Graph(after, before), _Graph(before, after)
    stood = [each for each in map(first.standing, before.activities) if not each.can_end]
    standings = tuple(_as_in(stood, each) for each in map(graph.standing, after.activities))
    return Explanation(_verdict(standings, before, after, graph), standings, after)


def _as_in(stood: list[Standing], now: Standing) -> Standing:
    if now.can_end or any(now.activity.stands_as(each.activity) for each in stood):
        return now
    return replace(now, can_end=True, waits_for=(), code=None)


class _Graph:
    def __init__(self, before: Look, after: Look) -> None:
        self.look = after
        self.waits: Mapping[int, Wait] = {
            index: wait_of(each, after) for index, each in enumerate(after.activities)
        }
        self.moved = {
            index
            for index, each in enumerate(after.activities)
            if not any(each.stands_as(other) for other in before.activities)
        }
        self.holders: dict[int, set[int]] = {}
        for index, each in enumerate(after.activities):
            # Who waits for a condition has let go of its lock.
            if self.waits[index].kind is not Kind.CONDITION:
                for lock, _ in locks_held(each):
                    self.holders.setdefault(lock, set()).add(index)
        self.executor_of = {e: each for each in after.executors for e in each.entities}
        self.live = self._least()

    def _least(self) -> set[int]:
        """The least set of those that can go on; whoever is outside of it never does."""
        live: set[int] = set()
        while True:
            more = {index for index in self.waits if self._goes_on(index, live)}
            if more <= live:
                return live
            live |= more

    def _goes_on(self, index: int, live: set[int]) -> bool:
        wait, look = self.waits[index], self.look
        if wait.kind is Kind.WORK:
            return False  # it acts by what it serves
        if index in self.moved or wait.timed or look.activities[index].is_awaited_done:
            return True
        if wait.kind is Kind.ANSWER and wait.resource is not None:
            client = look.entities[wait.resource]
            return self.is_served(client, live) and self._is_answered(client, live)
        if wait.kind is Kind.RATE:
            timer = look.entities.get(wait.resource or 0)
            # Who moves a simulated clock is not of this process.
            return timer is None or timer.simulated_clock or self.is_served(timer, live)
        if wait.kind is Kind.LOCK:
            holders = self._holders(wait.resource or 0)
            return not holders or bool(holders & live)
        if wait.kind is Kind.JOIN:
            thread = look.objects.get(wait.resource or 0, {})
            joined = self._thread(thread.get('ident'))
            return joined is None or joined in live or self.waits[joined].kind in _OWN_BUSINESS
        if wait.kind in _BY_ANYBODY:
            return self._may_anybody_act(live)
        return wait.kind is not Kind.SPIN

    def _holders(self, lock: int) -> set[int]:
        row = self.look.objects.get(lock, {})
        if row.get('kind') == 'RLock':
            owner = self._thread(row.get('owner'))
            return set() if owner is None else {owner}
        return self.holders.get(lock, set()) if row.get('locked') else set()

    def _thread(self, ident: object) -> int | None:
        found = (i for i, each in enumerate(self.look.activities) if each.ident == ident)
        return next(found, None) if ident is not None else None

    def _is_answered(self, client: Entity, live: set[int]) -> bool:
        """A server elsewhere may answer; one of this process has to be served, or at work."""
        servers = [
            each
            for each in self.look.entities.values()
            if each.kind == 'services' and each.key == client.key
        ]
        return not servers or any(
            self.is_served(each, live) or self._runs(each.number) & live for each in servers
        )

    def _runs(self, entity: int) -> set[int]:
        return {i for i, each in enumerate(self.look.activities) if entity in each.entities}

    def _may_anybody_act(self, live: set[int]) -> bool:
        return bool(live) or any(
            not each.builtin and self.is_served(each, live) for each in self.look.entities.values()
        )

    def is_served(self, entity: Entity, live: set[int]) -> bool:
        """Whether some thread can still begin a callback of it."""
        executor = self.executor_of.get(entity.number)
        if executor is None:
            return bool(live)
        if self.keepers(entity) and not self.keepers(entity) & live:
            return False
        if not self.spinners(executor) and not self._may_spin(executor, live):
            return False
        return executor.workers is None or (len(self.workers(executor) - live) < executor.workers)

    def keepers(self, entity: Entity) -> set[int]:
        """Who runs the callback that keeps the group of ``entity`` closed."""
        return self._runs(entity.active) if entity.active is not None else set()

    def spinners(self, executor: Executor) -> set[int]:
        return {index for index, wait in self.waits.items() if wait.spins == executor.number}

    def _may_spin(self, executor: Executor, live: set[int]) -> bool:
        return bool(live - self.workers(executor))

    def workers(self, executor: Executor) -> set[int]:
        """Threads of its pool that run something."""
        return {
            index
            for index, each in enumerate(self.look.activities)
            if self.waits[index].kind is not Kind.WORK
            and any(
                executor.pool is not None and f.objects.get('work_queue') == executor.pool
                for f in each.frames
                if f.is_in('concurrent.futures.thread', '_worker')
            )
        }

    def standing(self, activity: Activity) -> Standing:
        index = self.look.activities.index(activity)
        wait = self.waits[index]
        can_end = index in self.live or wait.kind is Kind.WORK
        if not activity.entities and wait.kind in _OWN_BUSINESS:
            can_end = True  # a thread that waits for work, or main for Ctrl-C
        told = () if can_end else tuple(self._obstacles(index))
        code = None if can_end else _code(self, index)
        return Standing(activity, wait, index in self.moved, can_end, told, code)

    def _obstacles(self, index: int) -> Iterator[str]:
        wait = self.waits[index]
        entity = self.look.entities.get(wait.resource or 0)
        if wait.kind is Kind.LOCK:
            for holder in sorted(self._holders(wait.resource or 0)):
                yield f'the lock is held by {self.say(holder)}'
        elif entity is not None:
            yield from self._why_not_served(entity)
            for each in self.look.entities.values():
                if each.kind == 'services' and each.key == entity.key:
                    yield from (f'the service: {told}' for told in self._why_not_served(each))
        elif wait.kind in _BY_ANYBODY:
            yield 'no thread moves, and no callback of the program that could end it can begin'
        elif wait.kind is Kind.SPIN:
            yield 'the callback ends when the executor is shut down, and not before'

    def _why_not_served(self, entity: Entity) -> Iterator[str]:
        for keeper in sorted(self.keepers(entity) - self.live):
            yield f'its callback group is closed by {self.say(keeper)}'
        executor = self.executor_of.get(entity.number)
        if executor is None:
            yield 'its node is in no executor'
        elif executor.workers is not None and len(stuck := self.workers(executor) - self.live) >= (
            executor.workers
        ):
            yield f'all {len(stuck)} threads of the pool stand'
        elif not self.spinners(executor):
            runs = [
                i
                for i, each in enumerate(self.look.activities)
                if executor.entities & set(each.entities) and self.waits[i].kind is not Kind.WORK
            ]
            told = f', whose thread runs {self.say(runs[0])}' if runs else ''
            yield f'nobody spins its {executor.cls}{told}'

    def say(self, index: int) -> str:
        activity = self.look.activities[index]
        place = activity.place
        return f'{activity.name}, {place.function} at {place.file}:{place.line}'


def _code(graph: _Graph, index: int) -> str | None:
    """The rule of `check` that finds such a wait in sources; none where none is certain."""
    wait, look = graph.waits[index], graph.look
    entity = look.entities.get(wait.resource or 0)
    if wait.kind is Kind.LOCK:
        return 'CC111'
    if wait.kind is Kind.SPIN:
        return 'CC106'
    if wait.kind is Kind.RATE:
        return 'CC105'
    if wait.kind is not Kind.ANSWER or entity is None:
        return 'CC109' if wait.kind is Kind.EVENT else None
    activity = look.activities[index]
    needed = {entity.active} | {
        each.active
        for each in look.entities.values()
        if each.kind == 'services' and each.key == entity.key
    }
    if needed & set(activity.entities):
        return 'CC106' if wait.spins else 'CC104' if activity.ident is None else 'CC101'
    executor = graph.executor_of.get(entity.number)
    if executor is None:
        return None
    if executor.workers is not None:
        return 'CC103' if len(graph.workers(executor) - graph.live) >= executor.workers else None
    return None if graph.spinners(executor) else 'CC102'


def _verdict(standings: tuple[Standing, ...], before: Look, after: Look, graph: _Graph) -> Verdict:
    if any(not each.can_end for each in standings):
        return Verdict.UNDECIDED if before.unread or after.unread else Verdict.DEADLOCK
    spun_before = {each.number for each in before.executors if each.spun}
    for each in after.executors:
        unspun = not each.spun and each.number not in spun_before
        if each.nodes and unspun and not graph.spinners(each):
            return Verdict.NOBODY_SPINS
    # Waits of main and of own threads count where only a callback, or another process, ends them.
    asking = [s for s in standings if s.activity.entities or s.wait.kind not in _OWN_BUSINESS]
    kinds = {s.wait.kind for s in asking if not s.wait.timed and not s.moved}
    if Kind.ANSWER in kinds and not kinds & {Kind.LOCK, *_BY_ANYBODY}:
        return Verdict.OUTSIDE
    if any(s.wait.kind is Kind.SERVICE for s in asking):
        return Verdict.OUTSIDE
    if kinds & {Kind.LOCK, Kind.JOIN, *_BY_ANYBODY}:
        return Verdict.UNDECIDED
    return Verdict.BUSY if any(s.in_callback for s in standings) else Verdict.HEALTHY
