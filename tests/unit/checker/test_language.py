"""Every construct of the supported subset, by what it makes reachable."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import EngineKind, read_model
from tests.support.published import document
from tests.support.small import automaton, holds, network, single

ENGINES = [EngineKind.REFERENCE, EngineKind.AUTO]


def value_of(expression: str, declaration: str = '', engine: EngineKind = EngineKind.AUTO) -> int:
    """Return what an update stores for an expression; searched for by queries."""
    model = single(f'a b\na -> b; do: result = ({expression})', declaration + ' int result;')
    candidates = [*range(-40, 41), 255, 1000]
    answers = holds(model, *(f'E<> P.b and result == {c}' for c in candidates), engine=engine)
    return candidates[answers.index(True)]


@pytest.mark.parametrize('engine', ENGINES)
@pytest.mark.parametrize(
    ('expression', 'value'),
    [
        ('2 + 3 * 4', 14),
        ('(2 + 3) * 4', 20),
        ('7 / x', -3),
        ('-7 / 2', -3),
        ('7 % x', 1),
        ('-7 % 2', -1),
        ('1 << 3', 8),
        ('-9 >> 1', -5),
        ('6 & 3', 2),
        ('6 | 3', 7),
        ('6 ^ 3', 5),
        ('x <? 3', -2),
        ('x >? 3', 3),
        ('x < 3', 1),
        ('x == -2 ? 5 : 6', 5),
        ('1 + (x > 0)', 1),
        ('not x == 3', 0),
        ('not (x == 3)', 1),
        ('false and true || true', 1),
        ('true || true and false', 1),
        ('true or true imply false', 0),
        ('true ? 0 : 1 or 1', 0),
        ('(z = 1 and 0) + 10 * z', 0),
        ('!x', 0),
        ('true and false', 0),
        ('x > 0 imply false', 1),
        ('x < 0 imply false', 0),
        ('x > 0 or y', 1),
        ('x xor y', 0),
        ('forall (i : int[0, 3]) i < 4', 1),
        ('exists (i : T) i == 4', 0),
        ('sum (i : T) i', 6),
        ('forall (i : T) exists (j : T) i + j == 3', 1),
        ('t[y]', 30),
        ('t[y + 1] - t[0]', 30),
        ('m[1][y]', 5),
        ('-x - -x', 0),
        ('+3', 3),
    ],
)
def test_expression_has_the_value_of_uppaal(
    expression: str, value: int, engine: EngineKind
) -> None:
    declaration = """
        int x = -2, z; bool y = true; typedef int[0, 3] T; const int t[3] = {10, 30, 40};
        int[0, 9] m[2][3] = {{1, 2, 3}, {4, 5, 6}};
    """
    assert value_of(expression, declaration, engine) == value


FUNCTIONS = """
typedef int[0, 9] T;
T a[4];
int log;
int twice(int x) { return 2 * x; }
int sum_to(int n) { int s; int i; for (i = 1; i <= n; i++) { s += i; } return s; }
int first_above(int limit) {
    for (i : int[0, 20]) { if (i * i > limit) return i; }
    return -1;
}
int collatz(int n) { int steps = 0; while (n != 1) { n = n % 2 == 0 ? n / 2 : 3 * n + 1; steps++; }
    return steps; }
int do_once() { int n = 0; do { n++; } while (n < 0); return n; }
int local_array() { int b[3] = {1, 2, 3}; b[1] += 5; return b[0] + b[1] * b[2]; }
int nested() { int n; { int n2 = 4; n = n2; } if (n == 4) n++; else { n = 0; } return n; }
int bump() { log++; return log; }
void set(T &cell, T value) { cell = value; }
int total(const T &cells[4]) { return sum (i : int[0, 3]) cells[i]; }
int fill() { set(a[1], 4); set(a[2], 5); return total(a); }
bool as_bool(int x) { return x; }
int shadow(int log) { log = 3; return log; }
const int t[2] = {1, 2};
const int u[2] = {3, 4};
int of_table(const int &table[2]) { int s; for (i : int[0, 1]) s = 10 * s + table[i]; return s; }
T grid[2][2] = {{1, 2}, {3, 4}};
int of_copy(int k, T row[2], int added) { row[0] = k * row[0]; return row[0] + row[1] + added; }
int of_copies(T rows[2][2]) { int s; for (i : int[0, 1]) s += of_copy(2, rows[i], 0); return s; }
"""


@pytest.mark.parametrize('engine', ENGINES)
@pytest.mark.parametrize(
    ('call', 'value'),
    [
        ('twice(4)', 8),
        ('twice(sum_to(3))', 12),
        ('sum_to(5)', 15),
        ('first_above(30)', 6),
        ('first_above(1000)', -1),
        ('collatz(6)', 8),
        ('do_once()', 1),
        ('local_array()', 22),
        ('nested()', 5),
        ('bump() + bump() * 10', 21),
        ('log + bump()', 1),
        ('fill()', 9),
        ('as_bool(7)', 1),
        ('shadow(8) + log', 3),
        ('of_table(t)', 12),
        ('of_table(t) - of_table(u)', -22),
        ('of_copy(2, grid[1], 1)', 11),
        ('of_copy(2, t, 0)', 4),
        ('of_copies(grid) + grid[0][0]', 15),
    ],
)
def test_function_call(call: str, value: int, engine: EngineKind) -> None:
    assert value_of(call, FUNCTIONS, engine) == value


@pytest.mark.parametrize('engine', ENGINES)
def test_array_is_indexed_by_the_values_of_its_index_type(engine: EngineKind) -> None:
    sender = automaton('S', 'a b\na -> b; select: i : Id; sync: c[i]!; do: got[i] = k[i]')
    receiver = automaton('R', 'a b\na -> b; sync: c[id]?', parameters='const Id id')
    declaration = 'typedef int[3, 5] Id; const int k[Id] = {7, 8, 9}; chan c[Id]; int got[Id];'
    model = network(sender, receiver, declaration=declaration, system='system S, R;')
    assert [v.name for v in model.elaboration.network().variables] == [
        'got[3]',
        'got[4]',
        'got[5]',
    ]
    assert holds(
        model,
        'A[] R(4).b imply got[4] == 8',
        'E<> got[5] == 9 and R(5).b',
        'A[] forall (i : Id) got[i] == 0 or R(i).b',
        engine=engine,
    ) == [True, True, True]


@pytest.mark.parametrize('engine', ENGINES)
def test_scalar_set_is_a_range_from_zero(engine: EngineKind) -> None:
    process = automaton(
        'P',
        'a b\na -> b; select: s : Set; guard: s != id; do: last = s, seen[id] = true',
        'Set id',
    )
    declaration = 'const int N = 3; typedef scalar[N] Set; Set last; bool seen[Set];'
    model = network(process, declaration=declaration)
    assert model.processes == ('P(0)', 'P(1)', 'P(2)')
    wanted = ['E<> forall (s : Set) seen[s]', 'A[] P(0).b imply seen[0]', 'E<> last == 2']
    assert holds(model, *wanted, engine=engine) == [True, True, True]


def test_instances_may_stand_apart_from_the_system_line() -> None:
    process = automaton('P', 'a\na -> a; do: x = id', parameters='const int id')
    text = document('int x;', process, 'system A, B;')
    older = text.replace('<system>', '<instantiation>A = P(1);\nB = P(2);</instantiation><system>')
    model = read_model(older, 'm.xml')
    assert model.processes == ('A', 'B')
    assert holds(model, 'E<> x == 1', 'E<> x == 2', 'E<> x == 3') == [True, True, False]


@pytest.mark.parametrize('engine', ENGINES)
def test_updates_run_in_order_and_know_steps_and_arrays(engine: EngineKind) -> None:
    model = single(
        'a b\na -> b; do: x = 3, y = x++, z = --x, b = c, b[1] -= 2, f = b == c, g = d == c',
        'int x, y, z; int b[2]; int c[2] = {5, 6}; int d[2] = {5, 6}; bool f, g;',
    )
    wanted = 'E<> P.b and x == 3 and y == 3 and z == 3 and b[0] == 5 and b[1] == 4 and !f and g'
    assert holds(model, wanted, engine=engine) == [True]


@pytest.mark.parametrize('engine', ENGINES)
def test_sender_updates_before_receiver(engine: EngineKind) -> None:
    sender = automaton('S', 'a b\na -> b; sync: c!; do: x = 1')
    receiver = automaton('R', 'a b\na -> b; sync: c?; do: y = x + 1')
    model = network(receiver, sender, declaration='chan c; int[0, 5] x, y;', system='system R, S;')
    assert holds(model, 'E<> y == 2', 'E<> y == 1', engine=engine) == [True, False]


@pytest.mark.parametrize('engine', ENGINES)
def test_receivers_guard_reads_the_state_before_the_step(engine: EngineKind) -> None:
    sender = automaton('S', 'a b\na -> b; sync: c!; do: x = 1')
    receiver = automaton('R', 'a b\na -> b; guard: x == 1; sync: c?')
    model = network(sender, receiver, declaration='chan c; int[0, 5] x;', system='system S, R;')
    assert holds(model, 'E<> R.b', 'E<> deadlock', engine=engine) == [False, True]


@pytest.mark.parametrize('engine', ENGINES)
def test_binary_channel_needs_one_partner_and_never_itself(engine: EngineKind) -> None:
    process = automaton('P', 'a b c\na -> b; sync: c!\na -> c; sync: c?')
    one = network(process, declaration='chan c;', system='A = P(); system A;')
    two = network(process, declaration='chan c;', system='A = P(); B = P(); system A, B;')
    assert holds(one, 'E<> A.b', engine=engine) == [False]
    assert holds(two, 'E<> A.b and B.c', 'E<> A.b and B.a', engine=engine) == [True, False]


@pytest.mark.parametrize('engine', ENGINES)
def test_broadcast_takes_all_that_are_ready_in_process_order(engine: EngineKind) -> None:
    sender = automaton('S', 'a b\na -> b; sync: c!; do: order = 0')
    receiver = automaton(
        'R',
        'a b\na -> b; guard: id != 1 || open; sync: c?; do: order = order * 10 + id + 1',
        parameters='const int[0, 2] id',
    )
    model = network(
        sender,
        receiver,
        declaration='broadcast chan c; int order; bool open;',
        system='system R, S;',
    )
    assert holds(
        model, 'A[] S.b imply order == 13', 'A[] S.b imply R(1).a', 'E<> S.b', engine=engine
    ) == [True, True, True]


@pytest.mark.parametrize('engine', ENGINES)
def test_broadcast_without_receivers_and_with_a_choice_of_edges(engine: EngineKind) -> None:
    sender = automaton('S', 'a b\na -> b; sync: c!')
    chooser = automaton('R', 'a b c\na -> b; sync: c?\na -> c; sync: c?')
    alone = network(sender, declaration='broadcast chan c;', system='system S;')
    both = network(sender, chooser, declaration='broadcast chan c;', system='system S, R;')
    assert holds(alone, 'E<> S.b', engine=engine) == [True]
    wanted = ['E<> R.b', 'E<> R.c', 'E<> S.b and R.a']
    assert holds(both, *wanted, engine=engine) == [True, True, False]


@pytest.mark.parametrize('engine', ENGINES)
def test_committed_location_goes_first_and_urgent_does_not(engine: EngineKind) -> None:
    other = automaton('O', 'a b\na -> b; do: x = 1')
    committed = automaton('P', 'a C:m b\na -> m\nm -> b; guard: x == 0')
    urgent = automaton('P', 'a U:m b\na -> m\nm -> b; guard: x == 0')
    query = ['E<> P.m and x == 1', 'E<> O.b and P.b']
    for template, expected in ((committed, [True, True]), (urgent, [True, True])):
        model = network(template, other, declaration='int[0,1] x;', system='system P, O;')
        assert holds(model, *query, engine=engine) == expected
    races = network(
        automaton('P', 'C:m b\nm -> b'), other, declaration='int[0,1] x;', system='system P, O;'
    )
    assert holds(races, 'E<> P.m and x == 1', engine=engine) == [False]


@pytest.mark.parametrize('engine', ENGINES)
def test_committed_receiver_lets_the_sender_go(engine: EngineKind) -> None:
    sender = automaton('S', 'a b\na -> b; sync: c!\na -> b; do: x = 1')
    receiver = automaton('R', 'C:a b\na -> b; sync: c?')
    for prefix in ('', 'broadcast '):
        model = network(
            sender,
            receiver,
            declaration=f'{prefix}chan c; int[0, 1] x;',
            system='system S, R;',
        )
        assert holds(model, 'E<> R.b', 'E<> x == 1 and R.a', engine=engine) == [True, False]


@pytest.mark.parametrize('engine', ENGINES)
def test_stuck_committed_location_is_a_deadlock(engine: EngineKind) -> None:
    model = network(
        automaton('P', 'a C:m\na -> m'), automaton('O', 'a\na -> a'), system='system P, O;'
    )
    assert holds(model, 'E<> deadlock', 'A[] deadlock imply P.m', engine=engine) == [True, True]


@pytest.mark.parametrize('engine', ENGINES)
def test_channel_arrays_and_indices_from_variables(engine: EngineKind) -> None:
    sender = automaton('S', 'a\na -> a; sync: c[next]!; do: next = (next + 1) % 3')
    receiver = automaton(
        'R', 'a b\na -> b; sync: c[id]?; do: got[id] = next', parameters='const int[0, 2] id'
    )
    model = network(
        sender,
        receiver,
        declaration='chan c[3]; int[0, 2] next, got[3];',
        system='system S, R;',
    )
    assert holds(
        model,
        'E<> R(0).b and R(1).b and R(2).b',
        'A[] R(2).b imply R(1).b',
        'A[] R(1).b imply got[1] == 2',
        engine=engine,
    ) == [True, True, True]


@pytest.mark.parametrize('engine', ENGINES)
def test_receiver_index_from_a_variable(engine: EngineKind) -> None:
    sender = automaton('S', 'a b\na -> b; select: i : int[1, 2]; sync: c[i]!; do: sent = i')
    receiver = automaton('R', 'a b\na -> b; sync: c[mine]?')
    for prefix in ('chan', 'broadcast chan'):
        model = network(
            sender,
            receiver,
            declaration=f'{prefix} c[3]; int[0, 2] mine = 2, sent;',
            system='system S, R;',
        )
        is_binary = prefix == 'chan'
        assert holds(model, 'E<> R.b and sent == 2', 'E<> sent == 1', engine=engine) == [
            True,
            not is_binary,
        ]


@pytest.mark.parametrize('engine', ENGINES)
def test_select_offers_every_value(engine: EngineKind) -> None:
    model = single(
        'a b\na -> b; select: i : int[2, 4], j : bool; guard: i != 3; do: x = i * 10 + j', 'int x;'
    )
    values = [20, 21, 30, 31, 40, 41]
    answers = holds(model, *(f'E<> x == {value}' for value in values), engine=engine)
    assert answers == [True, True, False, False, True, True]


def test_partial_instantiation_and_reference_parameters() -> None:
    process = automaton(
        'Counter',
        'a\na -> a; guard: cell < top; sync: go!; do: cell++',
        parameters='int[0, 9] &cell, broadcast chan &go, const int[0, 9] top',
    )
    model = network(
        process,
        declaration='int[0, 9] x, y[2]; broadcast chan c[2];',
        system='Half(const int[0, 1] i) = Counter(y[i], c[i], 2 + i);'
        'Whole = Counter(x, c[0], 4); system Half, Whole;',
    )
    assert model.processes == ('Half(0)', 'Half(1)', 'Whole')
    assert model.template_of('Half(1)') == 'Counter'
    assert model.process_index('Whole') == 2
    assert holds(
        model, 'E<> deadlock', 'A[] deadlock imply x == 4 and y[0] == 2 and y[1] == 3'
    ) == [True, True]


def test_queries_see_process_variables_parameters_and_constants() -> None:
    process = automaton(
        'P',
        'a\na -> a; guard: n[1] < top; do: n[1]++',
        parameters='const int[0, 9] top',
        local='int[0, 9] n[2]; const int k = 7;',
    )
    model = network(process, system='A = P(2); B = P(3); system A, B;')
    wanted = ['A[] A.n[1] <= A.top', 'E<> B.n[1] == 3', 'A[] A.n[1] < 2', 'A[] A.k == 7']
    assert holds(model, *wanted) == [True, True, False, True]


def test_variables_are_named_in_the_state_view() -> None:
    model = network(
        automaton('P', 'a b\na -> b; do: m[1][0] = 1; say: to b', local='bool m[2][2];'),
        declaration='int[3, 9] low; int[-5, -2] high; int[-1, 1] zero;',
        system='Q = P(); system Q;',
    )
    state = model.elaboration.network().variables
    assert [(v.name, v.initial) for v in state] == [
        ('low', 3),
        ('high', -2),
        ('zero', 0),
        ('Q.m[0][0]', 0),
        ('Q.m[0][1]', 0),
        ('Q.m[1][0]', 0),
        ('Q.m[1][1]', 0),
    ]
