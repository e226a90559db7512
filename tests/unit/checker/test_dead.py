"""Dead variables: what is forgotten, what must not be, and that no verdict changes."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.analyses.dead_variables import forgettings
from ros2cc_extract.checker.api import EngineKind, Fairness, Model, Query, check, read_model
from ros2cc_extract.checker.engines.search import formulas_of
from ros2cc_extract.source_locations import Place
from tests.support.published import Case, formulas, one_group, published_model
from tests.support.small import ask, automaton, network, single


def forgotten(model: Model, process: str, *queries: str) -> dict[str, set[str]]:
    """Return the variables that are reset in each location, whatever the controls are."""
    properties = [model.elaboration.query(query, Place('q', 1)) for query in queries]
    net = model.network
    number = model.process_index(process)
    found: dict[str, set[str]] = {}
    own = forgettings(net, formulas_of(properties))[number]
    for (location, _), resets in own.resets.items():
        names = {net.variables[slot].name for slot, _ in resets}
        found.setdefault(net.processes[number].locations[location].name, names)
        found[net.processes[number].locations[location].name] &= names
    return found


ROUND = """a b c
a -> b; do: x = (x + 1) % 3
b -> c; guard: x > 0; do: y = x
c -> a; do: x = 0"""


def test_value_is_dead_between_its_last_read_and_its_next_write() -> None:
    model = single(ROUND, local='int[0, 2] x, y;')
    assert forgotten(model, 'P', 'A[] not deadlock') == {
        'a': {'P.y'},
        'b': {'P.y'},
        'c': {'P.x', 'P.y'},
    }


def test_query_keeps_what_it_reads_alive() -> None:
    model = single(ROUND, local='int[0, 2] x, y;')
    assert forgotten(model, 'P', 'E<> P.x == 2 and P.y == 1') == {}
    assert forgotten(model, 'P', 'E<> P.b and P.x == 2') == {
        'a': {'P.y'},
        'b': {'P.y'},
        'c': {'P.x', 'P.y'},
    }


def test_only_what_stands_behind_a_condition_depends_on_it() -> None:
    model = single(ROUND, local='int[0, 2] x, y;')
    assert 'P.x' not in forgotten(model, 'P', 'E<> P.x == 2 and P.b').get('c', set())


def test_what_another_process_reads_is_never_dead() -> None:
    reader = automaton('R', 'a b\na -> b; guard: x == 2')
    writer = automaton('W', 'a b\na -> b; do: x = 2\nb -> a; do: x = 0')
    model = network(reader, writer, declaration='int[0, 2] x;', system='system R, W;')
    assert forgotten(model, 'W', 'A[] not deadlock') == {}


def test_elements_behind_the_index_are_dead() -> None:
    drawing = """look done
    look -> look; guard: i < 2 && seen[i]; do: i++
    look -> look; guard: i < 2 && !seen[i]; do: i++, n = (n + 1) % 4
    look -> done; guard: i == 2"""
    model = single(drawing, local='bool seen[3]; int[0, 3] i; int[0, 3] n;')
    assert forgotten(model, 'P', 'E<> P.n == 3')['done'] == {
        'P.seen[0]', 'P.seen[1]', 'P.seen[2]', 'P.i',
    }  # fmt: skip


def test_receiver_reads_what_its_senders_have_just_written() -> None:
    sender = automaton('S', 'a\na -> a; select: v : int[0, 3]; sync: c[to]!; do: box[to] = v')
    receiver = automaton(
        'R',
        'idle busy\nidle -> busy; sync: c[id]?; do: mine = box[id]\nbusy -> idle; do: kept = mine',
        parameters='const int[0, 1] id',
        local='int[0, 3] mine, kept;',
    )
    declaration = 'chan c[2]; int[0, 1] to; int[0, 3] box[2];'
    model = network(sender, receiver, declaration=declaration, system='system S, R;')
    assert forgotten(model, 'R(1)', 'E<> R(0).kept == 2 and R(1).kept == 1') == {
        'idle': {'box[1]', 'R(1).mine'},
        'busy': {'box[1]'},
    }


def test_conditions_do_not_forget_each_other() -> None:
    """Were both sides read only where the other holds, both could be set to their start."""
    model = single(
        'a b\na -> b; do: x = 0, y = 0',
        local='int[0, 1] x = 1, y = 1;',
    )
    for engine in (EngineKind.REFERENCE, EngineKind.AUTO):
        result = ask(model, 'A[] P.b imply not (P.x == 1 and P.y == 1)', engine=engine)
        assert result.answers[0].verdict.value == 'satisfied'


def compare(xml: str, queries: list[str], fairness: Fairness = Fairness.NONE) -> tuple[int, int]:
    """Return the states with and without reduction; the verdicts must be the same."""
    pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')
    model = read_model(xml, 'm.xml')
    asked = [Query(query, '', None) for query in queries]
    results = [
        check(model, asked, engine=EngineKind.NATIVE, reduction=reduction, fairness=fairness)
        for reduction in (True, False)
    ]
    patterns = [[answer.verdict for answer in result.answers] for result in results]
    assert patterns[0] == patterns[1]
    return results[0].states, results[1].states


@pytest.mark.parametrize('fairness', list(Fairness))
@pytest.mark.parametrize(
    'case',
    [
        one_group(2, 2, 'EXCLUSIVE'),
        one_group(2, 2, 'REENTRANT'),
        one_group(2, 2, 'REENTRANT', max_cycle=2),
        one_group(3, 2, 'REENTRANT'),
        Case((('TMR', 0), ('SUB', 1), ('SRV', 0)), ('EXCLUSIVE', 'REENTRANT'), 2),
        Case((('SUB', 1), ('CLT', 1), ('TMR', 0)), ('EXCLUSIVE', 'EXCLUSIVE'), 2),
    ],
)
def test_published_verdicts_do_not_change(case: Case, fairness: Fairness) -> None:
    reduced, full = compare(published_model(case), formulas(case), fairness)
    assert reduced * 2 < full


def test_published_case_2_shrinks_to_a_fifteenth() -> None:
    case = one_group(4, 4, 'EXCLUSIVE')
    reduced, full = compare(published_model(case), formulas(case))
    assert full == 300162
    assert reduced * 15 < full


def test_what_keeps_an_edge_closed_is_not_forgotten() -> None:
    model = single(
        """a b c
a -> b; do: done = 1
b -> c; guard: done < 1 && kept[done] == 0""",
        local='const int kept[2] = {0, 0}; int[0, 1] done;',
    )
    assert forgotten(model, 'P', 'E<> P.c').get('b', set()) == set()
    result = check(model, [Query('E<> P.c', '', None)], reduction=True)
    assert [answer.verdict.value for answer in result.answers] == ['not satisfied']
