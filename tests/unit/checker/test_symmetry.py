"""Which processes are found to be alike, which are not, and what is made of it."""

from __future__ import annotations

import re

import pytest

from ros2cc_extract.checker.analyses.symmetry import families
from ros2cc_extract.checker.api import (
    CheckResult,
    EngineKind,
    Fairness,
    Model,
    Query,
    Reductions,
    check,
    read_model,
)
from ros2cc_extract.checker.engines.search import Symmetry, formulas_of
from ros2cc_extract.source_locations import Place
from tests.support.published import formulas, one_group, published_model
from tests.support.small import automaton, network

WORKER = """idle U:busy
idle -> busy; sync: call[id]?; do: at_work[id] = true
busy -> idle; do: at_work[id] = false, done = !done"""
BOSS = """a
a -> a; select: t : Id; guard: !at_work[t]; sync: call[t]!; do: job[t] = done"""
DATA = 'typedef int[0, 2] Id; chan call[Id]; bool at_work[Id], job[Id], done;'
SYSTEM = 'w0 = W(0); w1 = W(1); w2 = W(2); system w0, B, w1, w2;'
ALWAYS = Reductions(symmetry=Symmetry.ALWAYS)


def crowd(worker: str = WORKER, boss: str = BOSS, data: str = DATA, local: str = '') -> Model:
    return network(
        automaton('W', worker, 'const Id id', local),
        automaton('B', boss, local='Id some;'),
        declaration=data,
        system=SYSTEM,
    )


def alike(model: Model, *queries: str) -> list[set[str]]:
    """Return the names of the processes of each family."""
    properties = [model.elaboration.query(query, Place('q', 1)) for query in queries]
    found = families(model.network, formulas_of(properties))
    return [{model.processes[number] for number in family.processes} for family in found]


def decide(model: Model, *queries: str, reduction: bool | Reductions = ALWAYS) -> CheckResult:
    return check(model, [Query(query, '', None) for query in queries], reduction=reduction)


def test_workers_that_know_only_themselves_are_alike() -> None:
    model = crowd(local='bool seen[2];')
    assert alike(model, 'E<> exists (t : Id) at_work[t] && job[t]') == [{'w0', 'w1', 'w2'}]


def test_query_that_names_one_keeps_it_apart() -> None:
    assert alike(crowd(), 'E<> w1.busy') == [{'w0', 'w2'}]
    assert alike(crowd(), 'E<> at_work[0] and job[1]') == []


@pytest.mark.parametrize(
    'edge',
    [
        'idle -> idle; guard: id == 0; do: done = true',
        'idle -> idle; guard: id < 2',
        'idle -> idle; do: job[(id + 1) % 3] = true',
        'idle -> idle; guard: at_work[0]',
        'idle -> idle; do: job[0] = true',
        'idle -> idle; guard: exists (t : Id) t < id && at_work[t]',
        'idle -> idle; do: top = id * 2',
        'idle -> idle; guard: rank[last] == 1 && last != id; do: last = id',
        'idle -> idle; guard: last > id; do: last = id',
        'idle -> idle; guard: exists (t : Id) 6 / level[t] > 2',
    ],
)
def test_worker_that_does_more_with_its_name_is_told_apart(edge: str) -> None:
    data = f'{DATA} int[0, 4] level[Id], top; Id last; const int rank[Id] = {{1, 2, 3}};'
    found = alike(crowd(f'{WORKER}\n{edge}', data=data), 'A[] not deadlock')
    assert {'w0', 'w1', 'w2'} not in found


def test_worker_with_more_room_is_told_apart() -> None:
    assert alike(crowd(local='int[0, id + 1] own;'), 'A[] not deadlock') == []


@pytest.mark.parametrize(
    ('pick', 'expected'),
    [
        ('for (t : Id) if (!at_work[t]) return t; return 0;', [{'w0', 'w1', 'w2'}]),
        ('for (t : Id) if (!at_work[t] && t != 1) return t; return 0;', [{'w0', 'w2'}]),
        ('for (t : int[0, 1]) if (!at_work[t]) return t; return 0;', [{'w0', 'w1'}]),
        ('for (t : Id) if (!at_work[t]) return 2 - t; return 0;', []),
    ],
)
def test_whom_a_function_picks(pick: str, expected: list[set[str]]) -> None:
    boss = 'a\na -> a; do: some = lowest()\na -> a; sync: call[some]!'
    model = crowd(boss=boss, data=f'{DATA} Id lowest() {{ {pick} }}')
    assert alike(model, 'A[] not deadlock') == expected


def test_names_may_be_stored_and_compared() -> None:
    worker = f'{WORKER}\nidle -> idle; guard: last != id; do: last = id'
    model = crowd(worker, data=f'{DATA} Id last;')
    assert alike(model, 'A[] not deadlock') == [{'w0', 'w1', 'w2'}]
    assert alike(model, 'E<> last == 1') == [{'w0', 'w2'}]
    assert alike(model, 'E<> at_work[last]') == [{'w0', 'w1', 'w2'}]


def test_calculated_name_is_no_name() -> None:
    boss = f'{BOSS}\na -> a; guard: at_work[some]; do: some = (some + 1) % 3'
    assert alike(crowd(boss=boss), 'A[] not deadlock') == []


def test_receivers_whose_order_shows_are_told_apart() -> None:
    worker = f'{WORKER}\nidle -> idle; sync: all?; do: done = job[id]'
    model = crowd(worker, f'{BOSS}\na -> a; sync: all!', f'{DATA} broadcast chan all;')
    assert alike(model, 'A[] not deadlock') == []


def test_states_that_differ_in_who_is_who_are_one() -> None:
    query = 'E<> forall (t : Id) at_work[t]'
    full = decide(crowd(), query, 'A[] not deadlock', reduction=False)
    merged = decide(
        crowd(),
        query,
        'A[] not deadlock',
        reduction=Reductions(dead=False, symmetry=ALWAYS.symmetry),
    )
    assert merged.states < full.states / 2
    assert [a.verdict for a in merged.answers] == [a.verdict for a in full.answers]


LOWEST = 'Id lowest() { for (t : Id) if (!at_work[t]) return t; return 0; }'


def test_lowest_of_those_that_are_alike_tells_nobody_apart() -> None:
    boss = """a U:b
    a -> b; guard: exists (t : Id) !at_work[t]; do: some = lowest()
    b -> a; sync: call[some]!"""
    model = crowd(boss=boss, data=DATA + LOWEST)
    full = decide(model, 'A[] not deadlock', reduction=False)
    assert decide(model, 'A[] not deadlock').states < full.states


def test_lowest_of_those_that_differ_shows_and_symmetry_is_given_up() -> None:
    worker = f'{WORKER}\nidle -> idle; do: job[id] = !job[id]'
    boss = 'a\na -> a; sync: call[lowest()]!'
    model = crowd(worker, boss, DATA + LOWEST)
    queries = 'E<> exists (t : Id) job[t] && at_work[t]', 'A[] not deadlock'
    dead_only = Reductions(symmetry=Symmetry.NEVER)
    assert alike(model, *queries) == [{'w0', 'w1', 'w2'}]
    assert decide(model, *queries).states == decide(model, *queries, reduction=dead_only).states


def test_path_is_one_of_the_model_with_its_own_names() -> None:
    query = 'E<> forall (t : Id) at_work[t]'
    answer = decide(crowd(), query).answers[0]
    assert answer.path is not None
    last = answer.path.steps[-1].state
    assert {name: last.locations[name] for name in ('w0', 'w1', 'w2')} == {
        'w0': 'busy', 'w1': 'busy', 'w2': 'busy',
    }  # fmt: skip


def test_cycle_goes_on_until_everybody_is_back() -> None:
    worker = WORKER.replace('idle U:busy', 'U:idle U:busy')
    query = 'E[] (exists (t : Id) at_work[t]) or not done'
    answer = decide(crowd(worker), query).answers[0]
    assert answer.path is not None
    assert answer.path.cycle_start is not None
    again = answer.path.steps[answer.path.cycle_start - 1].state
    assert answer.path.steps[-1].state.variables == again.variables


def test_weak_fairness_tells_everybody_apart() -> None:
    query = Query('exists (t : Id) at_work[t] --> done', '', None)
    results = [
        check(crowd(), [query], reduction=Reductions(symmetry=s), fairness=Fairness.WEAK)
        for s in (Symmetry.NEVER, Symmetry.ALWAYS)
    ]
    assert results[0].states == results[1].states


LOWEST_IDLE = """ThreadId idle_thread() {
    for (t : ThreadId) if (!thread_running[t]) return t;
    return 0;
}"""


def test_threads_of_the_published_model_are_alike() -> None:
    case = one_group(4, 4, 'REENTRANT')
    text = re.sub(r'ThreadId idle_thread.*?\n}', LOWEST_IDLE, published_model(case), flags=re.S)
    model = read_model(text, 'published.xml')
    queries = [Query(formula, '', None) for formula in formulas(case)]
    result = check(model, queries, engine=EngineKind.NATIVE)
    assert (result.states, result.transitions) == (102_165, 356_271)
    pattern = ''.join(answer.verdict.value[0] for answer in result.answers)
    assert pattern == 'sssss' + 'nnnnnn' + 'nnnn' + 'ssssss' + 's' + 'nnss'
