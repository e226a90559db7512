"""
The wait-for graph of processes: which waits for which, and whether any wait can still end.

What may end a wait is taken too wide rather than too narrow: an event may be set by any callback
that can still be served and by any thread that still moves. So nothing is left that could end
what is called a deadlock, and what is not decided is said to be so. Source of what can be served:
rclpy 7.1.6 and 9.1.2, ``Executor.can_execute`` and ``_make_handler``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, Wait, locks_held, wait_of
from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Entity, Executor, Look

BY_ANY_CODE = (Kind.EVENT, Kind.CONDITION, Kind.QUEUE, Kind.FUTURE)
"""Waits that any running code of the process may end."""
_ANSWERS = (Kind.ANSWER, Kind.ACTION)
_OWN_BUSINESS = (Kind.EVENT, Kind.CONDITION, Kind.QUEUE, Kind.WORK, Kind.FUTURE, Kind.JOIN)


class Verdict(Enum):
    """What the process does, in a few words."""

    DEADLOCK = 'deadlock'
    NEVER_SPUN = 'never spun'
    IN_NO_EXECUTOR = 'in no executor'
    ASLEEP = 'asleep'
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
    :param asleep: it could go on, but the executor that runs it sleeps.
    :param reasons: what keeps the wait from its end, or where the answer comes from, in words.
    :param asked: other processes that offer the service whose answer is awaited.
    :param code: of the rule that finds such a wait in sources.
    """

    activity: Activity
    wait: Wait
    moved: bool
    can_end: bool
    asleep: bool = False
    reasons: tuple[str, ...] = ()
    asked: tuple[int, ...] = ()
    code: str | None = None

    @property
    def in_callback(self) -> bool:
        return bool(self.activity.entities)


NOT_PROVEN = 'from the wait-for graph, not proven by the model'


@dataclass(frozen=True)
class Explanation:
    """
    :param proof: what the verdict rests on, in words.
    """

    process: int
    verdict: Verdict
    standings: tuple[Standing, ...]
    look: Look
    proof: str = NOT_PROVEN


Looks = tuple[Look, Look]
"""What was seen of a process, and what was seen later."""


def explain(process: int, looks: Looks) -> Explanation:
    """Judge one process alone."""
    return explain_together({process: looks})[process]


def explain_together(looks: Mapping[int, Looks]) -> dict[int, Explanation]:
    """
    Judge processes that may wait for each other.

    Only what stands still, and has nothing left that could end it, in both looks counts: one look
    is no instant, as the frames are read some milliseconds before the groups.

    :param looks: of all processes; each second one is later than each first one.
    """
    first = _solved({each: (after, before) for each, (before, after) in looks.items()})
    last = _solved(looks)
    return {each: _explanation(first[each], last[each]) for each in looks}


def _solved(looks: Mapping[int, Looks]) -> dict[int, _Graph]:
    """Find the least sets of those that can go on; what is outside of them never does."""
    graphs = {each: _Graph(each, *of_one) for each, of_one in looks.items()}
    for graph in graphs.values():
        graph.others = tuple(each for each in graphs.values() if each is not graph)
    while any([graph.grows() for graph in graphs.values()]):  # noqa: C419  each of them is to grow
        pass
    return graphs


def _explanation(first: _Graph, last: _Graph) -> Explanation:
    before, after = first.look, last.look
    stood = [first.standing(index) for index in range(len(before.activities))]
    standings = tuple(
        _confirmed(last.standing(index), stood) for index in range(len(after.activities))
    )
    return Explanation(last.process, _verdict(standings, before, last), standings, after)


def _confirmed(now: Standing, stood: Sequence[Standing]) -> Standing:
    """Keep of what is found in the last look only what was found in the first one too."""
    was = next((each for each in stood if now.activity.stands_as(each.activity)), None)
    if was is None or (was.can_end and not now.can_end):
        now = replace(now, can_end=True, reasons=(), code=None)
    return replace(now, asleep=now.asleep and was is not None and was.asleep)


class _Graph:
    """
    What can go on in one process.

    :param before: the look to compare with; may be the later one.
    :param look: the look that is judged.
    """

    def __init__(self, process: int, before: Look, look: Look) -> None:
        self.process = process
        self.look = look
        self.others: tuple[_Graph, ...] = ()
        self.live: set[int] = set()
        self.waits: Mapping[int, Wait] = {
            index: wait_of(each, look) for index, each in enumerate(look.activities)
        }
        self.moved = {
            index
            for index, each in enumerate(look.activities)
            if not any(each.stands_as(other) for other in before.activities)
        }
        self.holders: dict[int, set[int]] = {}
        for index, each in enumerate(look.activities):
            # A thread that waits for a condition has released its lock.
            if self.waits[index].kind is not Kind.CONDITION:
                for lock, _ in locks_held(each):
                    self.holders.setdefault(lock, set()).add(index)
        self.executor_of = {e: each for each in look.executors for e in each.entities}

    @property
    def title(self) -> str:
        return f'process {self.process} ({", ".join(self.look.nodes)})'

    def grows(self) -> bool:
        """Add those that can go on, given what is known to go on; whether there were any."""
        more = {index for index in self.waits if index not in self.live and self._goes_on(index)}
        self.live |= more
        return bool(more)

    def _goes_on(self, index: int) -> bool:
        wait, look = self.waits[index], self.look
        if wait.kind is Kind.WORK:
            return False  # it acts by what it serves
        if index in self.moved or wait.timed or look.activities[index].is_awaited_done:
            return True
        if wait.kind in _ANSWERS and wait.resource is not None:
            client = look.entities[wait.resource]
            return self.is_served(client) and self._is_answered(client)
        if wait.kind is Kind.RATE:
            timer = look.entities.get(wait.resource or 0)
            # A simulated clock is moved by another process.
            return timer is None or timer.simulated_clock or self.is_served(timer)
        if wait.kind is Kind.LOCK:
            holders = self._holders(wait.resource or 0)
            return not holders or bool(holders & self.live)
        if wait.kind is Kind.JOIN:
            thread = look.objects.get(wait.resource or 0, {})
            joined = self._thread(thread.get('ident'))
            own = joined is None or self.waits[joined].kind in _OWN_BUSINESS
            return own or joined in self.live
        if wait.kind in BY_ANY_CODE:
            return self._may_any_code_act()
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

    def _is_answered(self, client: Entity) -> bool:
        """A server that is not known may answer; one that is has to be served, or at work."""
        servers = self.servers_of(client)
        return not servers or any(graph.answers(each) for graph, each in servers)

    def servers_of(self, client: Entity) -> list[tuple[_Graph, Entity]]:
        """Give all servers of its service; none where there may be one that is not known."""
        own, all_known = (
            [
                (graph, each)
                for graph in graphs
                for each in graph.look.entities.values()
                if each.is_service and each.service == client.service
            ]
            for graphs in ((self,), (self, *self.others))
        )
        if client.servers is None or client.servers == len(own):
            return own
        return all_known if client.servers == len(all_known) else []

    def answers(self, service: Entity) -> bool:
        """Whether a request may be answered; so it is where not everything could be read."""
        at_work = self._runs(service.number) & self.live
        return bool(self.look.unread or at_work) or self.is_served(service)

    def _runs(self, entity: int) -> set[int]:
        return {i for i, each in enumerate(self.look.activities) if entity in each.entities}

    def _may_any_code_act(self) -> bool:
        return bool(self.live) or any(
            not each.builtin and self.is_served(each) for each in self.look.entities.values()
        )

    def is_served(self, entity: Entity) -> bool:
        """Whether some thread can still begin a callback of it."""
        executor = self.executor_of.get(entity.number)
        if executor is None:
            return bool(self.live)
        if self.keepers(entity) and not self.keepers(entity) & self.live:
            return False
        if not self._may_be_spun(executor):
            return False
        return executor.workers is None or len(self.stuck(executor)) < executor.workers

    def keepers(self, entity: Entity) -> set[int]:
        """The threads that run the callback that keeps the group of ``entity`` closed."""
        return self._runs(entity.active) if entity.active is not None else set()

    def has_lost_a_node(self, before: Look) -> bool:
        """
        A thread spins an executor that holds no node, and a node with callbacks is in none.

        A node that is spun in turns (``spin_once`` in a loop) is in none for moments, but then no
        thread spins an empty executor.
        """
        served = {
            each for look in (before, self.look) for e in look.executors for each in e.entities
        }
        lost = (each for each in self.look.entities.values() if not each.builtin)
        empty_before = {each.number for each in before.executors if not each.nodes}
        return any(each.number not in served for each in lost) and any(
            not each.nodes and each.number in empty_before and self.spinners(each)
            for each in self.look.executors
        )

    def spinners(self, executor: Executor) -> set[int]:
        return {index for index, wait in self.waits.items() if wait.spins == executor.number}

    def _may_be_spun(self, executor: Executor) -> bool:
        """A thread spins it, or one that goes on may be about to."""
        return bool(self.spinners(executor) or self.live - self.workers(executor))

    def stuck(self, executor: Executor) -> set[int]:
        """Threads of its pool that never go on."""
        return self.workers(executor) - self.live

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

    def standing(self, index: int) -> Standing:
        activity, wait = self.look.activities[index], self.waits[index]
        can_end = index in self.live or wait.kind is Kind.WORK
        if not activity.entities and wait.kind in _OWN_BUSINESS:
            can_end = True  # a thread that waits for work, or main for Ctrl-C
        elsewhere = self._servers_elsewhere(wait)
        return Standing(
            activity,
            wait,
            index in self.moved,
            can_end,
            self._is_asleep(index),
            tuple(self._sources(elsewhere) if can_end else self._obstacles(index)),
            tuple(sorted({graph.process for graph, _ in elsewhere})),
            None if can_end else _code(self, index),
        )

    def _is_asleep(self, index: int) -> bool:
        """
        Whether what a coroutine awaits is done, and its executor sleeps.

        It goes on as soon as something else wakes the executor, as a timer will.
        """
        activity = self.look.activities[index]
        executor = next((e for e in self.look.executors if e.number == activity.executor), None)
        if not activity.is_awaited_done or index in self.moved or executor is None:
            return False
        spinners = self.spinners(executor)
        timers = (self.look.entities[each] for each in executor.entities)
        return (
            bool(spinners - self.moved)
            and not any(self.waits[each].timed for each in spinners)
            and all(each.kind != 'timers' or each.cancelled for each in timers)
        )

    def is_answered_here(self, wait: Wait) -> bool:
        """Whether it waits for an answer that only services of this process give."""
        client = self.look.entities.get(wait.resource or 0)
        if wait.kind not in _ANSWERS or client is None:
            return False
        servers = self.servers_of(client)
        return bool(servers) and all(graph is self for graph, _ in servers)

    def _servers_elsewhere(self, wait: Wait) -> list[tuple[_Graph, Entity]]:
        client = self.look.entities.get(wait.resource or 0)
        if wait.kind is not Kind.ANSWER or client is None:
            return []
        return [(graph, each) for graph, each in self.servers_of(client) if graph is not self]

    def _sources(self, servers: Sequence[tuple[_Graph, Entity]]) -> Iterator[str]:
        for graph, service in servers:
            runs = sorted(graph._runs(service.number))
            at = f'; {graph.say(runs[0])} is at work on a request' if runs else ''
            yield f'it is offered by {graph.title}{at}'

    def _obstacles(self, index: int) -> Iterator[str]:
        wait = self.waits[index]
        entity = self.look.entities.get(wait.resource or 0)
        if wait.kind is Kind.LOCK:
            for holder in sorted(self._holders(wait.resource or 0)):
                yield f'the lock is held by {self.say(holder)}'
        elif entity is not None:
            yield from self._why_not_served(entity)
            if wait.kind is Kind.ANSWER:
                yield from self._why_not_answered(entity)
        elif wait.kind in BY_ANY_CODE:
            yield 'no thread moves, and no callback of the program that could end it can begin'
        elif wait.kind is Kind.SPIN:
            yield 'the callback ends when the executor is shut down, and not before'

    def _why_not_answered(self, client: Entity) -> Iterator[str]:
        for graph, service in self.servers_of(client):
            where = '' if graph is self else f', offered by {graph.title},'
            for reason in graph._why_not_served(service):
                yield f'the service{where} is not served: {reason}'

    def _why_not_served(self, entity: Entity) -> Iterator[str]:
        for keeper in sorted(self.keepers(entity) - self.live):
            yield f'its callback group is closed by {self.say(keeper)}'
        executor = self.executor_of.get(entity.number)
        if executor is None:
            yield 'its node is in no executor'
        elif executor.workers is not None and len(self.stuck(executor)) >= executor.workers:
            yield f'no thread of the pool is free: {len(self.stuck(executor))} of them wait'
        elif not self._may_be_spun(executor):
            runs = [
                i
                for i, each in enumerate(self.look.activities)
                if executor.entities & set(each.entities) and self.waits[i].kind is not Kind.WORK
            ]
            by = f', whose thread runs {self.say(runs[0])}' if runs else ''
            yield f'no thread spins its {executor.cls}{by}'

    def say(self, index: int) -> str:
        activity = self.look.activities[index]
        place = activity.place
        return f'{place.called} ({activity.name}) at {place.at_line}'


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
    if wait.kind not in _ANSWERS or entity is None:
        return 'CC109' if wait.kind is Kind.EVENT else None
    activity, servers = look.activities[index], graph.servers_of(entity)
    needed = {entity.active} | {each.active for owner, each in servers if owner is graph}
    if needed & set(activity.entities):
        return 'CC106' if wait.spins else 'CC104' if activity.ident is None else 'CC101'
    executor = graph.executor_of.get(entity.number)
    if executor is None:
        return None
    if graph.is_served(entity):
        return 'CC109' if any(owner is not graph for owner, _ in servers) else None
    if executor.workers is not None:
        return 'CC103' if len(graph.stuck(executor)) >= executor.workers else None
    return None if graph.spinners(executor) else 'CC102'


def _verdict(standings: Sequence[Standing], before: Look, graph: _Graph) -> Verdict:
    after = graph.look
    if any(not each.can_end for each in standings):
        return Verdict.UNDECIDED if before.unread or after.unread else Verdict.DEADLOCK
    spun_before = {each.number for each in before.executors if each.spun}
    for each in after.executors:
        unspun = not each.spun and each.number not in spun_before
        if each.nodes and unspun and not graph.spinners(each):
            return Verdict.NEVER_SPUN
    if graph.has_lost_a_node(before):
        return Verdict.IN_NO_EXECUTOR
    if any(each.asleep for each in standings):
        return Verdict.ASLEEP
    return _verdict_on_waits(standings, graph)


def _verdict_on_waits(standings: Sequence[Standing], graph: _Graph) -> Verdict:
    # Waits of main and of own threads count where only a callback, or another process, ends them.
    asking = [s for s in standings if s.activity.entities or s.wait.kind not in _OWN_BUSINESS]
    standing = [s for s in asking if not s.wait.timed and not s.moved]
    kinds = {s.wait.kind for s in standing}
    here = [s for s in standing if graph.is_answered_here(s.wait)]
    by_others = [s for s in standing if s.wait.kind in _ANSWERS and s not in here]
    if by_others and not kinds & {Kind.LOCK, *BY_ANY_CODE}:
        return Verdict.OUTSIDE
    if any(s.wait.kind is Kind.SERVER for s in asking):
        return Verdict.OUTSIDE
    at_work = [s for s in standings if s.in_callback and (s.moved or s.wait.timed)]
    if kinds & {Kind.LOCK, Kind.JOIN, *BY_ANY_CODE} or (here and not at_work):
        return Verdict.UNDECIDED
    return Verdict.BUSY if any(s.in_callback for s in standings) else Verdict.HEALTHY
