"""
From a look at a hanging process to a unit of the model: one executor and what waits there.

The unit has the callbacks that wait forever by the wait-for graph, each with the wait in which it
stands, and all callbacks that may end one of these waits. Others are left out: a callback that
neither waits nor ends a wait holds nothing up forever, so a run with it is one without it. What
may end a wait is taken too wide, as in the graph.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, locks_held
from ros2cc_extract.extract.live.hang_analysis.samples import Entity, Executor, Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Explanation, Standing
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.effects import Blocking, Needs, Waker
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    GroupType,
    Origin,
    Spec,
)
from ros2cc_extract.spec.model import Executor as UnitExecutor

MOST_CALLBACKS = 24
_KINDS = {
    'timers': EntityKind.TIMER,
    'subscriptions': EntityKind.SUBSCRIPTION,
    'services': EntityKind.SERVICE,
    'clients': EntityKind.CLIENT,
    'guards': EntityKind.GUARD_CONDITION,
    'waitables': EntityKind.WAITABLE,
}
_EXECUTORS = ('SingleThreadedExecutor', 'MultiThreadedExecutor')
_ANSWERS = (Kind.ANSWER, Kind.ACTION)
_BY_ANY_CODE = (Kind.EVENT, Kind.CONDITION, Kind.QUEUE, Kind.FUTURE)
_CALLS = {Kind.RATE: 'Rate.sleep', Kind.LOCK: 'Lock.acquire', Kind.CONDITION: 'Condition.wait'}


class UnprovableError(Exception):
    """Why the model has no word for a snapshot, as a clause."""


@dataclass(frozen=True)
class StandingRun:
    """
    What waits forever: runs of one callback in one wait.

    :param callback: place of the callback in the unit.
    :param client: place of the client whose answer is awaited; ``None`` where a signal is.
    :param runs: how many of them stand there.
    :param is_suspended: it has given its thread back.
    """

    callback: int
    client: int | None
    runs: int
    is_suspended: bool


@dataclass(frozen=True)
class SnapshotUnit:
    """
    :param standing: all that waits forever, as the snapshot has it.
    :param arrivals: how often data arrives for a callback, where that is more than once: for each
        run that stands, and for one more that may end a wait of the others.
    """

    spec: Spec
    standing: tuple[StandingRun, ...]
    arrivals: Mapping[str, int]


def unit_of(explanation: Explanation) -> SnapshotUnit:
    """
    Make the unit of what waits forever.

    :raises UnprovableError: where no unit can say it.
    """
    look = explanation.look
    stuck = [each for each in explanation.standings if not each.can_end]
    executor = _executor_of(stuck, look)
    needed = _Needed(look, executor, stuck)
    return needed.unit()


def _executor_of(stuck: Sequence[Standing], look: Look) -> Executor:
    """Give the one executor whose callbacks all that waits are."""
    found = set()
    for each in stuck:
        entities = set(each.activity.entities)
        if not entities:
            raise UnprovableError(f'{each.activity.name} waits outside of callbacks')
        if len(entities) > 1 or each.wait.spins is not None:
            raise UnprovableError('a callback spins an executor')
        if each.asked:
            raise UnprovableError('another process is part of it')
        executors = {e.number for e in look.executors if entities <= e.entities}
        if not executors:
            raise UnprovableError('a callback that waits is of no executor')
        found |= executors
    (executor, *others) = (each for each in look.executors if each.number in found)
    if others:
        raise UnprovableError('callbacks of more than one executor wait')
    if executor.cls not in _EXECUTORS:
        raise UnprovableError(f'the model does not have {executor.cls}')
    return executor


class _Needed:
    """The callbacks of one executor that the proof needs, and their waits."""

    def __init__(self, look: Look, executor: Executor, stuck: Sequence[Standing]) -> None:
        self.look, self.executor = look, executor
        self.stuck: dict[int, list[Standing]] = {}
        for each in stuck:
            self.stuck.setdefault(each.activity.entities[0], []).append(each)
        for standings in self.stuck.values():
            waits = {(s.wait.kind, s.wait.resource, s.activity.ident is None) for s in standings}
            if len(waits) > 1:
                raise UnprovableError('one callback waits for different things at a time')
        numbers = {*self.stuck, *(n for s in self.stuck.values() for n in self._partners(s[0]))}
        # In the order in which the node has them, which is that of their creation.
        self.entities = [e for e in look.entities.values() if e.number in numbers]
        if len(self.entities) > MOST_CALLBACKS:
            raise UnprovableError(f'more than {MOST_CALLBACKS} callbacks may end a wait')
        self.names = {e.number: f'c{place}' for place, e in enumerate(self.entities)}
        self.places = {e.number: place for place, e in enumerate(self.entities)}

    def _partners(self, standing: Standing) -> Iterator[int]:
        """Give the entities that may end a wait, and those that these need."""
        wait = standing.wait
        if wait.kind in _ANSWERS:
            client = self.look.entities.get(wait.resource or 0)
            if client is None or client.number not in self.executor.entities:
                raise UnprovableError('a client is served by another executor, or by none')
            yield client.number
            for each in self._own():
                if each.is_service and each.service == client.service:
                    yield each.number
        elif wait.kind is Kind.RATE:
            if wait.resource not in self.executor.entities:
                raise UnprovableError('the timer of a rate is of another executor, or of none')
            yield wait.resource or 0
        elif wait.kind in _BY_ANY_CODE:
            yield from (each.number for each in self._own() if not each.builtin)
        elif wait.kind is Kind.LOCK:
            yield from self._holders(wait.resource or 0)
        else:
            raise UnprovableError(f'the model has no wait for {wait.kind.value}')

    def _own(self) -> Iterator[Entity]:
        return (e for e in self.look.entities.values() if e.number in self.executor.entities)

    def _holders(self, lock: int) -> tuple[int, ...]:
        """Return the callbacks that hold a lock; each of them waits itself."""
        owner = self.look.objects.get(lock, {}).get('owner')
        holders = tuple(
            number
            for number, standings in self.stuck.items()
            for each in standings
            if lock in {held for held, _ in locks_held(each.activity)}
            or (owner is not None and each.activity.ident == owner)
        )
        if not holders:
            raise UnprovableError('no callback that waits holds the lock')
        return holders

    def unit(self) -> SnapshotUnit:
        groups = dict.fromkeys(e.group for e in self.entities)
        group_names = {number: f'g{place}' for place, number in enumerate(groups)}
        callbacks = tuple(self._callback(each, group_names[each.group]) for each in self.entities)
        arrivals = {e.number: self._arrivals(e) for e in self.entities}
        spec = Spec(
            name='snapshot',
            callbacks=callbacks,
            groups=tuple(self._groups(group_names)),
            executor=self._executor(sum(arrivals.values()) + 1),
            origin=Origin.LIVE,
            nodes=tuple(dict.fromkeys(e.node for e in self.entities)),
        )
        more = {self.names[number]: most for number, most in arrivals.items() if most > 1}
        return SnapshotUnit(spec, tuple(self._standing()), more)

    def _arrivals(self, entity: Entity) -> int:
        """
        Beside its runs that stand, one of a reentrant group may run once more and end a wait.

        It would seem to give back the locks that only the others hold.
        """
        runs = len(self.stuck.get(entity.number, ()))
        kinds = {each.wait.kind for stands in self.stuck.values() for each in stands}
        if not runs or entity.exclusive or not kinds & set(_BY_ANY_CODE):
            return runs or 1
        if Kind.LOCK in kinds:
            raise UnprovableError('a reentrant callback waits, and so does one for a lock')
        return runs + 1

    def _executor(self, most_at_a_time: int) -> UnitExecutor:
        """Threads beyond those that callbacks can take at a time change nothing."""
        threads = min(self.executor.workers or 1, most_at_a_time)
        names = tuple(f't{number}' for number in range(threads))
        return UnitExecutor(name='e', threads=names, kind=self.executor.cls)

    def _groups(self, names: Mapping[int, str]) -> Iterator[CallbackGroup]:
        for number, name in names.items():
            exclusive = any(e.exclusive for e in self.entities if e.group == number)
            kind = GroupType.EXCLUSIVE if exclusive else GroupType.REENTRANT
            yield CallbackGroup(name=name, type=kind)

    def _callback(self, entity: Entity, group: str) -> Callback:
        kind = EntityKind.ACTION_CLIENT if entity.cls == 'ActionClient' else _KINDS[entity.kind]
        stands = self.stuck.get(entity.number, [])
        return Callback(
            name=self.names[entity.number],
            type=kind.published_type,
            group=group,
            entity=kind,
            node=entity.node,
            key=None if entity.key is None else f'{entity.domain}:{entity.key}',
            coroutine=any(each.activity.ident is None for each in stands),
            blocking=(self._blocking(stands[0]),) if stands else (),
        )

    def _blocking(self, standing: Standing) -> Blocking:
        wait = standing.wait
        is_await = standing.activity.ident is None
        if wait.kind in _ANSWERS:
            return Blocking(
                call='await' if is_await else 'client.call', on=self.names[wait.resource or 0]
            )
        if wait.kind is Kind.LOCK:
            wakers = self._wakers(self._holders(wait.resource or 0), after=1)
        else:
            wakers = self._wakers(self._partners(standing), after=None)
        return Blocking(
            call='await' if is_await else _CALLS.get(wait.kind, 'Event.wait'),
            resource=f'object {wait.resource}',
            wakers=wakers,
            # What was there before it began to wait has not ended the wait.
            needs=Needs.EACH,
            forgets=True,
        )

    def _wakers(self, numbers: Iterable[int], after: int | None) -> tuple[Waker, ...]:
        """``after`` its own wait, if it holds a lock and waits; else at its end."""
        return tuple(Waker(by=self.names[n], after=after) for n in dict.fromkeys(numbers))

    def _standing(self) -> Iterator[StandingRun]:
        for number, stands in self.stuck.items():
            wait = stands[0].wait
            client = self.places[wait.resource or 0] if wait.kind in _ANSWERS else None
            yield StandingRun(
                self.places[number], client, len(stands), stands[0].activity.ident is None
            )
