"""
Looks for runs that end, by chance: one run to its end after the other, and nothing stored.

A state in which nothing moves any more lies at the end of a run, where a breadth-first search of
a large model never comes in its time. What a dive refutes is refuted by a run of the model; what
none refutes is open. Chance is drawn from a fixed seed: equal models get equal answers.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import chain, islice
from typing import Any

from ros2cc_extract.checker.engines.generated_successors import Moving, Plan
from ros2cc_extract.checker.engines.limits import Limits, Watch, peak_mb
from ros2cc_extract.checker.engines.search import (
    End,
    StatePath,
    goal_of,
    inside_of,
    is_reachability,
)
from ros2cc_extract.checker.engines.state_layout import Layout
from ros2cc_extract.checker.engines.terms import Fairness, Verdict
from ros2cc_extract.checker.network.network import Expr, Network, Property, QueryKind
from ros2cc_extract.checker.network.semantics import Semantics
from ros2cc_extract.checker.runs.answers import Answer, CheckResult
from ros2cc_extract.checker.runs.replay import Replayer
from ros2cc_extract.checker.uppaal.files.query_file import Query
from ros2cc_extract.checker.uppaal.model import Model
from ros2cc_extract.source_locations import Place

LONGEST_DIVE = 4_000
MOST_DIVES = 1_000
#: So many dives that refute nothing more are enough.
PATIENCE = 250
_NOT_REFUTED = 'no run that was tried refutes it'
_UNNAMED = Place('query', 1)


def dive(
    model: Model, queries: Sequence[Query], *, limits: Limits, avoided: str | None = None
) -> CheckResult:
    """
    Refute what runs to an end refute of ``queries``; all else is left undecided.

    :param avoided: what half of the runs come to only where nothing else can happen.
    """
    properties = [model.elaboration.query(q.formula, q.place or _UNNAMED) for q in queries]
    asked = None if avoided is None else model.elaboration.query(f'E<> {avoided}', _UNNAMED)
    divers = _Divers(model.network, properties, limits, asked.formula if asked else None)
    paths = divers.run()
    replayer = Replayer(model.elaboration, model.network, Fairness.NONE)
    answers = []
    for number, (query, prop) in enumerate(zip(queries, properties, strict=True)):
        path = paths.get(number)
        if path is not None:
            replayer.run(prop, path, None)  # a verdict needs a run that shows it
        answers.append(
            Answer(
                query=query,
                verdict=Verdict.UNDECIDED if path is None else Verdict.NOT_SATISFIED,
                reason=_NOT_REFUTED if path is None else None,
                seconds=divers.watch.seconds(),
                replay=None if path is None else partial(replayer.run, prop, path, None),
            )
        )
    return CheckResult(
        engine='dives',
        states=divers.states,
        transitions=divers.states,
        seconds=divers.watch.seconds(),
        peak_mb=peak_mb(),
        complete=False,
        answers=tuple(answers),
    )


class _Likes(dict[int, float]):
    """How much one dive likes a move, by its label: drawn when it is first asked for."""

    def __init__(self, chance: random.Random) -> None:
        super().__init__()
        self._chance = chance

    def __missing__(self, label: int) -> float:
        self[label] = liking = self._chance.random()
        return liking


Step = tuple[Any, int]


class _Habits:
    """
    How one dive chooses among moves: any alike, or most often the one that it likes best.

    What happens late in most runs, or early, does not in one that dislikes or likes it.
    """

    def __init__(self, chance: random.Random, *, is_even: bool) -> None:
        self._chance, self._is_even = chance, is_even
        self._likes = _Likes(chance)
        self._liked: dict[int, list[Step]] = {}

    def ordered(self, vector: int, plan: Plan) -> Iterable[Step]:
        """The steps of a plan, as they are tried; ``vector`` is what it is the plan of."""
        if self._is_even or self._chance.random() > _OFTEN:
            begin = int(self._chance.random() * len(plan.steps))
            return chain(islice(plan.steps, begin, None), islice(plan.steps, begin))
        if vector not in self._liked:
            likes = self._likes
            self._liked[vector] = sorted(plan.steps, key=lambda step: likes[step[1]])
        return self._liked[vector]


_OFTEN = 0.9


class _Divers:
    def __init__(
        self,
        network: Network,
        properties: Sequence[Property],
        limits: Limits,
        avoided: Expr | None,
    ) -> None:
        self._layout = Layout(network)
        self._moving = Moving(network, self._layout)
        self._start = self._layout.pack(Semantics(network).initial())
        self._plans: dict[int, Plan] = {}
        self._chance = random.Random(0)
        # What the last state of a run shows: nothing moves on, so no claimed state comes.
        self._ends = {QueryKind.INVARIANT: None, QueryKind.LEADS_TO: End.DEADLOCK}
        self._kinds = [prop.kind for prop in properties]
        self._open = {i for i, kind in enumerate(self._kinds) if kind in self._ends}
        self._refuted = self._moving.predicate([*map(_refutation, properties)])
        self._begun = self._moving.predicate([p.premise or _refutation(p) for p in properties])
        self._avoided = None if avoided is None else self._moving.predicate([avoided])
        self.watch = Watch(limits, None)
        self.states = 0

    def run(self) -> dict[int, StatePath]:
        """Dive until nothing more is refuted; by number of the property a run that refutes it."""
        found: dict[int, StatePath] = {}
        idle = 0
        for number in range(MOST_DIVES):
            if not self._open or idle >= PATIENCE or self.watch.exhausted():
                break
            path = self._dive(
                _Habits(self._chance, is_even=number % 2 == 0), avoids=number % 4 < 2
            )
            bits = self._refuted(path[-1], True) & self._begun(path[-1], True) if path else 0
            refuted = {i for i in self._open if bits >> i & 1}
            idle = 0 if refuted else idle + 1
            self._open -= refuted
            if refuted:
                states = tuple(map(self._layout.unpack, path))
                for i in refuted:
                    found[i] = StatePath(states, None, self._ends[self._kinds[i]])
        return found

    def _dive(self, habits: _Habits, *, avoids: bool) -> list[int]:
        """One run to its end; nothing where it has none within so many steps."""
        path = [self._start]
        while len(path) < LONGEST_DIVE:
            following = self._next(path[-1], habits, avoids=avoids)
            if following < 0:
                self.states += len(path)
                return path
            path.append(following)
        self.states += len(path)
        return []

    def _next(self, packed: int, habits: _Habits, *, avoids: bool) -> int:
        """The state after this one; -1 where nothing moves."""
        avoided = self._avoided if avoids else None
        otherwise = -1
        for target in self._targets(packed, habits):
            if avoided is None or not avoided(target, False):
                return target
            otherwise = target
        return otherwise

    def _targets(self, packed: int, habits: _Habits) -> Iterator[int]:
        vector = packed & self._layout.location_mask
        plan = self._plans.get(vector)
        if plan is None:
            plan = self._plans[vector] = self._moving.plan(packed)
        for move, label in habits.ordered(vector, plan):
            if label >= 0:
                target: int = move(packed)
                if target >= 0:
                    yield target
                continue
            targets = move(packed)
            if targets:
                yield self._chance.choice(targets)[0]


def _refutation(prop: Property) -> Expr:
    return goal_of(prop) if is_reachability(prop) else inside_of(prop)
