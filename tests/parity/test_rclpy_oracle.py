"""
Profile rclpy against a second, hand-written description of the same executors.

The oracle knows no UPPAAL. Compared are all steps between situations that a developer could see:
what has arrived and was not taken, what the executor is serving, what is queued, in which order,
and what runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from random import Random

import pytest

from ros2cc_extract.checker.network.semantics import Semantics, State
from ros2cc_extract.checker.uppaal.elaboration.elaborate import elaborate
from ros2cc_extract.checker.uppaal.files.document import read_document
from ros2cc_extract.generator.build import Profile, render
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
)

SINGLE, MULTI, EVENTS = 'SingleThreadedExecutor', 'MultiThreadedExecutor', 'EventsExecutor'
QUEUES = {MULTI: ('pool_queue', 'pool_size'), EVENTS: ('event_queue', 'event_count')}
#: In which order kinds are served.
SERVED = [CallbackType.TMR, CallbackType.SUB, CallbackType.CLT, CallbackType.SRV]


@dataclass(frozen=True)
class View:
    """One value per callback, the queue of the pool or of events, and what runs, sorted."""

    waiting: tuple[int, ...]
    arrived: tuple[int, ...]
    pool: tuple[int, ...] = ()
    running: tuple[int, ...] = ()


@dataclass(frozen=True)
class Situation:
    """A view, and what the last wait found and was not served; nothing while waiting."""

    view: View
    harvest: frozenset[int] = frozenset()


Step = tuple[Situation, Situation]


@dataclass(frozen=True)
class Oracle:
    """The executors of rclpy as a transition system."""

    kinds: tuple[CallbackType, ...]
    groups: tuple[int, ...]
    exclusive: frozenset[int]
    threads: int
    arrivals: int
    executor: str

    def successors(self, now: Situation) -> Iterator[Situation]:
        yield from self._arrivals(now)
        yield from self._ends(now)
        if self.executor == SINGLE:
            yield from self._spin_alone(now)
        elif self.executor == EVENTS:
            yield from self._serve_event(now)
        else:
            yield from self._spin_with_pool(now)
            yield from self._take_from_pool(now)

    def _arrivals(self, now: Situation) -> Iterator[Situation]:
        view = now.view
        for c, kind in enumerate(self.kinds):
            is_due = kind is CallbackType.TMR and view.waiting[c] == 1
            if view.arrived[c] < self.arrivals and not is_due:
                waiting, arrived = bump(view.waiting, c, 1), bump(view.arrived, c, 1)
                pool = (*view.pool, c) if self.executor == EVENTS else view.pool
                yield replace(now, view=View(waiting, arrived, pool, view.running))

    def _ends(self, now: Situation) -> Iterator[Situation]:
        for place in range(len(now.view.running)):
            running = now.view.running[:place] + now.view.running[place + 1 :]
            yield replace(now, view=replace(now.view, running=running))

    def _spin_alone(self, now: Situation) -> Iterator[Situation]:
        if now.view.running:
            return
        if not now.harvest:
            found = frozenset(c for c, count in enumerate(now.view.waiting) if count)
            if found:
                yield replace(now, harvest=found)
            return
        c = self._first(now.harvest)
        yield Situation(self._begin(now.view, c), now.harvest - {c})

    def _serve_event(self, now: Situation) -> Iterator[Situation]:
        if now.view.pool and not now.view.running:
            c, *rest = now.view.pool
            yield replace(now, view=self._begin(replace(now.view, pool=tuple(rest)), c))

    def _spin_with_pool(self, now: Situation) -> Iterator[Situation]:
        view = now.view
        if not now.harvest:
            candidates = set(range(len(self.kinds))) - set(view.pool)
            ready = {c for c in candidates if view.waiting[c] and not self._is_closed(view, c)}
            if ready:
                yield replace(now, harvest=frozenset(ready))
            return
        c = self._first(now.harvest)
        if not self._is_closed(view, c):
            view = replace(view, pool=(*view.pool, c))
        yield Situation(view, now.harvest - {c})

    def _take_from_pool(self, now: Situation) -> Iterator[Situation]:
        view = now.view
        if view.pool and len(view.running) < self.threads:
            c, *rest = view.pool
            after = replace(view, pool=tuple(rest))
            refused = self._is_closed(view, c)
            yield replace(now, view=after if refused else self._begin(after, c))

    def _begin(self, view: View, c: int) -> View:
        running = tuple(sorted((*view.running, c)))
        return replace(view, waiting=bump(view.waiting, c, -1), running=running)

    def _is_closed(self, view: View, c: int) -> bool:
        held = {self.groups[other] for other in view.running}
        return self.groups[c] in held & self.exclusive

    def _first(self, harvest: frozenset[int]) -> int:
        return min(harvest, key=lambda c: (SERVED.index(self.kinds[c]), c))

    def steps(self) -> set[Step]:
        """All that can happen."""
        none = (0,) * len(self.kinds)
        situations = reachable(Situation(View(none, none)), self.successors)
        return {(now, then) for now in situations for then in self.successors(now)}


def bump(values: tuple[int, ...], place: int, by: int) -> tuple[int, ...]:
    return (*values[:place], values[place] + by, *values[place + 1 :])


def reachable(initial, successors: Callable):  # type: ignore[no-untyped-def]
    seen, todo = {initial}, [initial]
    while todo:
        for target in successors(todo.pop()):
            if target not in seen:
                seen.add(target)
                todo.append(target)
    return seen


def steps_of_the_model(unit: ClosedSpec, arrivals: int) -> set[Step]:
    """Steps between states in which nothing is half done, but for those that change nothing."""
    xml = render(unit, profile=Profile.RCLPY, max_cycle=arrivals).xml
    network = elaborate(read_document(xml.encode(), 'unit.xml')).network()
    semantics = Semantics(network)
    place = {variable.name: index for index, variable in enumerate(network.variables)}
    numbers = range(len(unit.spec.callbacks))
    # An executor without a pool has one, however many its unit names.
    threads = range(sum(name.startswith('thread_running[') for name in place))

    def is_whole(state: State) -> bool:
        locations = zip(network.processes, state.locations, strict=True)
        return not any(process.locations[at].is_committed for process, at in locations)

    def situation(state: State) -> Situation:
        def value(name: str) -> int:
            return state.values[place[name]]

        queue, size = QUEUES.get(str(unit.spec.executor.kind), ('', ''))
        queued = range(value(size)) if size else ()
        view = View(
            waiting=tuple(value(f'cb_waiting[{c}]') for c in numbers),
            arrived=tuple(value(f'c{c}.arrived') for c in numbers),
            pool=tuple(value(f'{queue}[{p}]') for p in queued),
            running=tuple(
                sorted(
                    value(f'thread_cb_assign_table[{t}]')
                    for t in threads
                    if value(f'thread_running[{t}]')
                )
            ),
        )
        serves_events = unit.spec.executor.kind == EVENTS
        found = () if serves_events else numbers
        harvest = frozenset(c for c in found if value(f'executor.harvest[{c}]'))
        return Situation(view, harvest)

    def successors(state: State) -> Iterator[State]:
        for transition in semantics.successors(state):
            if is_whole(transition.target):
                yield transition.target
            else:
                yield from successors(transition.target)

    states = reachable(semantics.initial(), successors)
    steps = {(situation(now), situation(then)) for now in states for then in successors(now)}
    return {(now, then) for now, then in steps if now != then}


def draw(number: int) -> tuple[Oracle, ClosedSpec]:
    """One unit, given to both."""
    random = Random(number)
    size, threads = random.randint(1, 3), random.randint(1, 3)
    groups = tuple(random.randrange(2) for _ in range(size))
    types = [random.choice(list(GroupType)) for _ in range(2)]
    oracle = Oracle(
        kinds=tuple(random.choice(SERVED) for _ in range(size)),
        groups=groups,
        exclusive=frozenset(g for g in range(2) if types[g] is GroupType.EXCLUSIVE),
        threads=threads,
        arrivals=random.choice((1, 1, 2)),
        executor=random.choice((SINGLE, MULTI, MULTI, EVENTS)),
    )
    spec = Spec(
        name='unit',
        callbacks=tuple(
            Callback(name=f'c{c}', type=kind, group=f'g{groups[c]}')
            for c, kind in enumerate(oracle.kinds)
        ),
        groups=tuple(CallbackGroup(name=f'g{g}', type=types[g]) for g in range(2)),
        executor=Executor(
            name='executor',
            kind=oracle.executor,
            threads=tuple(f'thread_{t}' for t in range(threads)),
        ),
    )
    return oracle, close(spec)


@pytest.mark.parametrize('number', range(20))
def test_model_and_oracle_take_the_same_steps(number: int):
    oracle, unit = draw(number)
    assert steps_of_the_model(unit, oracle.arrivals) == oracle.steps()
