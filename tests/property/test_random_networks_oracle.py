"""
Verdicts on random networks against a slow oracle that knows nothing of searches.

The oracle writes the state graph down by the plain semantics and works the path formulae out as
fixpoints over sets of states, as the textbooks define them.
"""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from ros2cc_extract.checker.api import EngineKind, Query, check, read_model
from ros2cc_extract.checker.network.network import Expr, Property, QueryKind
from ros2cc_extract.checker.network.semantics import Semantics, State
from ros2cc_extract.source_locations import Place
from tests.support.networks import random_model

LONG = pytest.mark.slow
SEEDS = [*range(10_000, 10_020), *(pytest.param(n, marks=LONG) for n in range(10_020, 10_040))]


@dataclass(frozen=True)
class Graph:
    """States by number, their successors, and where a path may stay or end forever."""

    semantics: Semantics
    states: list[State]
    successors: list[list[int]]
    ends: set[int]

    def where(self, formula: Expr) -> set[int]:
        """States in which a formula holds."""
        return {
            number
            for number, state in enumerate(self.states)
            if self.semantics.evaluate(formula, state, not self.successors[number])
        }

    def some_path_stays(self, inside: set[int]) -> set[int]:
        """EG: the greatest set of states inside that end there or have a successor in it."""
        staying = set(inside)
        while True:
            kept = {
                number
                for number in staying
                if number in self.ends or staying.intersection(self.successors[number])
            }
            if kept == staying:
                return staying
            staying = kept


def graph_of(semantics: Semantics) -> Graph:
    states = [semantics.initial()]
    numbers = {states[0]: 0}
    successors: list[list[int]] = []
    for state in states:
        targets = [transition.target for transition in semantics.successors(state)]
        for target in targets:
            if numbers.setdefault(target, len(states)) == len(states):
                states.append(target)
        successors.append([numbers[target] for target in targets])
    ends = {
        number
        for number, state in enumerate(states)
        if not successors[number] or semantics.may_idle(state)
    }
    return Graph(semantics, states, successors, ends)


def verdict(graph: Graph, prop: Property) -> bool:
    everywhere = set(range(len(graph.states)))
    holds = graph.where(prop.formula)
    if prop.kind is QueryKind.INVARIANT:
        return holds == everywhere
    if prop.kind is QueryKind.REACHABLE:
        return bool(holds)
    if prop.kind is QueryKind.POSSIBLY_ALWAYS:
        return 0 in graph.some_path_stays(holds)
    avoiding = graph.some_path_stays(everywhere - holds)
    if prop.kind is QueryKind.EVENTUALLY:
        return 0 not in avoiding
    assert prop.premise is not None
    return not avoiding & graph.where(prop.premise)


@pytest.mark.parametrize('seed', SEEDS)
def test_both_engines_give_the_verdicts_of_the_textbook(seed: int) -> None:
    drawn = random_model(seed)
    model = read_model(drawn.text, 'random.xml')
    place = Place('random.q', 1)
    properties = [model.elaboration.query(formula, place) for formula in drawn.formulas]
    graph = graph_of(Semantics(model.network))
    expected = [verdict(graph, prop) for prop in properties]
    queries = [Query(formula, '', None) for formula in drawn.formulas]
    for engine in (EngineKind.REFERENCE, EngineKind.AUTO):
        answers = check(model, queries, engine=engine).answers
        assert [answer.verdict.value == 'satisfied' for answer in answers] == expected
