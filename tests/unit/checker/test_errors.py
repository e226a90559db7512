"""Every wrong model gets one line: where, what, how to mend."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.checker.api import (
    EngineKind,
    Limits,
    Query,
    check,
    load_model,
    read_model,
    read_queries,
)
from ros2cc_extract.errors import InputError, ModelFormatError
from tests.support.published import document, edge, location, template
from tests.support.small import ask, automaton, network, single, verdicts

ENGINES = [EngineKind.REFERENCE, EngineKind.AUTO]


def message(text: str) -> str:
    with pytest.raises(ModelFormatError) as caught:
        read_model(text, 'm.xml')
    assert '\n' not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('', 'm.xml: the file is empty; '),
        (' \n ', 'm.xml: the file is empty; '),
        ('hello', 'm.xml:1: not well-formed XML: syntax error; save the model again from UPPAAL'),
        (
            'clock x;\nprocess P() { state a; init a; }\nsystem P;',
            'm.xml:1: not well-formed XML: syntax error; the textual formats .xta and .ta are not',
        ),
        ('\0\1\2', 'm.xml: the file is binary, not XML; '),
        ('<nta>\n<template>\n', 'm.xml:3: not well-formed XML: no element found; '),
        ('<html/>', 'm.xml:1: not a UPPAAL model: the root element is <html>, not <nta>; '),
        ('<nta></nta>', 'm.xml:1: the model has no <system>; '),
        (
            '<!DOCTYPE n [<!ENTITY a "b">\n<!ENTITY c "&a;&a;">]><nta>&c;</nta>',
            "m.xml:1: the document declares the entity 'a'; ",
        ),
        ('<nta>' * 1_000_000, 'm.xml:1: XML elements nest deeper than 64; '),
        ('<nta>\n<lsc>x</lsc></nta>', 'm.xml:2: <lsc> is outside the supported subset'),
    ],
)
def test_file_that_is_no_model(text: str, expected: str) -> None:
    assert message(text).startswith(expected)


def test_doctype_of_uppaal_is_accepted_and_not_loaded() -> None:
    doctype = "<!DOCTYPE nta PUBLIC '-//Uppaal Team//DTD Flat System 1.6//EN' 'http://x/f.dtd'>"
    text = document('', automaton('P', 'a'), 'system P;').replace('<nta>', doctype + '<nta>')
    assert read_model(text, 'm.xml').processes == ('P',)


def test_missing_and_undecodable_files(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r'cannot be read: No such file or directory'):
        load_model(tmp_path / 'none.xml')
    (tmp_path / 'latin.xml').write_bytes(b'<nta>\n\xff</nta>')
    with pytest.raises(ModelFormatError, match=r'latin.xml:2: not well-formed XML'):
        load_model(tmp_path / 'latin.xml')


TEMPLATE = automaton('P', 'a\na -> a')


@pytest.mark.parametrize(
    ('declaration', 'expected'),
    [
        ('clock x;', 'm.xml:4: the type clock is outside the supported subset'),
        ('double d;', 'm.xml:4: the type double is outside the supported subset'),
        ('meta int x;', 'm.xml:4: meta variables are not supported; remove the word; '),
        ('chan a; chan priority a < default;', 'm.xml:4: channel priorities are outside'),
        ('struct { int a; } s;', 'm.xml:4: structs are outside the supported subset'),
        ('const string s = "x";', 'm.xml:4: strings are outside the supported subset'),
        ('import "x.so" { int f(); };', 'm.xml:4: external functions are outside the supported'),
        ('const int x = 2 ** 3;', 'm.xml:4: the power operator ** is outside'),
        ('int x; /* open', 'm.xml:4: a comment is not closed; close it with */'),
        ('int f() { while (true) { break; } return 1; } const int y = f();',
         "m.xml:4: 'break' is a keyword of UPPAAL; name a variable"),
        ('int a[3]; int f(int c[2]) { return c[0]; } const int y = f(a);',
         'm.xml:4: parameter c of f needs an array of its own size; name such an array'),
        ('chan c; void f(chan d) { } const int y = f(c);',
         'm.xml:4: parameter d takes a copy of a channel; write & before its name'),
        ('int x = 1.5;', 'm.xml:4: floating-point numbers are outside the supported subset'),
        ('int x\nint y;', "m.xml:5: syntax error at 'int'"),
        ('int x = y;', "m.xml:4: 'y' is not declared"),
        ('int count; int x = cuont;', "'cuont' is not declared; did you mean 'count'?"),
        ('int x; int x;', "m.xml:4: 'x' is declared twice"),
        ('int x = 1; int y = x;', 'm.xml:4: the value is not known before the model runs'),
        ('int[0, 3] x = 4;', 'm.xml:4: 4 is outside the range 0..3 of x'),
        ('int[3, 0] x;', 'm.xml:4: the range 3..0 is empty'),
        ('int a[3] = {1, 2};', 'm.xml:4: a needs 3 initial values'),
        ('int a[0];', 'm.xml:4: an array of 0 elements'),
        ('const int a[int[1, 3]] = {4, 5, 6}; const int x = a[0];',
         'm.xml:4: index 0 is outside a, which has 3 elements; use 1..3'),
        ('const int t[2] = {1, 2}; int x = t[2];', 'm.xml:4: index 2 is outside t, which has 2'),
        ('const int x = 1 / 0;', 'm.xml:4: division by zero'),
        ('const int x = 1 << 40;', 'm.xml:4: shift by 40 bits'),
        ('const int x = 99999999999;', 'm.xml:4: the number does not fit into 32 bits'),
        ('const int x = 65536 * 65536;', 'm.xml:4: 4294967296 does not fit into 32 bits'),
        ('int big[2000000];', 'm.xml:4: more than 1000000 variables'),
        ('tpyo x;', "m.xml:4: there is no type 'tpyo'"),
        ('int deadlock;', "m.xml:4: 'deadlock' is a keyword of UPPAAL"),
        ('int state;', "m.xml:4: 'state' is a keyword of UPPAAL"),
        ('const int x = 3; int f() { x = 4; return 1; } const int y = f();',
         'm.xml:4: x is constant and cannot be assigned'),
        ('int f(int n) { return n > 0 ? f(n - 1) : 0; } const int y = f(3);',
         'm.xml:4: f calls itself'),
        ('int f(int n) { return n; } const int y = f(1, 2);', 'm.xml:4: f takes 1 arguments'),
        ('const int y = g(1);', "m.xml:4: 'g' is no function"),
        ('int a[2]; const int y = a;', 'm.xml:4: a is an array, not a value'),
        ('chan c; const int y = c;', 'm.xml:4: c is a channel, not a value'),
        ('int x; const int y = x[0];', 'm.xml:4: x is no array'),
        ('const int y = ' + '-' * 1000 + '1;', 'm.xml:4: the text nests deeper than 100'),
    ],
)  # fmt: skip
def test_wrong_declaration(declaration: str, expected: str) -> None:
    assert expected in message(document('\n' + declaration, TEMPLATE, 'system P;'))


@pytest.mark.parametrize(
    ('system', 'expected'),
    [
        ('system Q;', "there is no template or process 'Q'; known are P"),
        ('', 'the model has 0 system lines'),
        ('system P < P;', 'process priorities are outside the supported subset'),
        ('system P,\n P < P;', 'process priorities are outside the supported subset'),
        ('system P, P;', 'process P stands twice in the system line'),
        ('A = P(3); system A;', 'P takes 0 arguments; 1 are given'),
        ('A = N(30); system A;', '30 is outside the range 0..3 of parameter id of N'),
        ('B = N(30); system P;', '30 is outside the range 0..3 of parameter id of N'),
        ('A(int[0, 9] i) = N(i); system A;', '4 is outside the range 0..3 of parameter id of N'),
        ('system R;', 'parameter cell of R has no value'),
        ('A = R(1); system A;', 'only variables and array elements can stand here'),
        ('system P; progress { 1; }', 'progress measures are outside the supported subset'),
    ],
)
def test_wrong_system(system: str, expected: str) -> None:
    numbered = automaton('N', 'a', parameters='const int[0, 3] id')
    referring = automaton('R', 'a', parameters='int &cell')
    assert expected in message(document('', TEMPLATE + numbered + referring, system))


@pytest.mark.parametrize(
    ('labels', 'expected'),
    [
        ({'guard': 'x ='}, 'the text ends too early'),
        ({'guard': 'x = 1'}, 'the guard changes variables'),
        ({'guard': 'a[x++] == 1'}, 'an array index changes variables'),
        ({'guard': 'y'}, "'y' is not declared"),
        ({'synchronisation': 'c'}, 'the synchronisation has no direction; end it with ! or ?'),
        ({'synchronisation': 'x!'}, 'x is no single channel'),
        ({'synchronisation': 'd!'}, 'd is no single channel'),
        ({'assignment': 'c = 1'}, 'c is a channel, not a value'),
        ({'assignment': 'i = 1', 'select': 'i : int[0,1]'}, 'i is constant and cannot'),
        ({'assignment': 'a = b'}, 'a needs an array of the same size'),
        ({'select': 'i : chan'}, 'chan is no integer type'),
        ({'select': 'i : int[0, 250000]'}, 'selects and instances make more than 250000 edges'),
        (
            {'guard': 'forall (i : int[0, 999]) exists (j : int[0, 999]) i + j > x'},
            'quantifiers inside quantifiers unfold into more than 200000 terms',
        ),
        ({'probability': '3'}, "an edge label of kind 'probability' is outside"),
    ],
)
def test_wrong_edge(labels: dict[str, str], expected: str) -> None:
    declaration = 'int x; int a[2]; int b[3]; chan c; chan d[2];'
    process = template('P', '', '', location('a'), 'a', edge('a', 'a', **labels))
    text = message(document(declaration, process, 'system P;'))
    assert expected in text
    assert text.startswith('m.xml:7: ')


def test_invariant_and_branchpoint_are_refused() -> None:
    place = '<location id="a"><name>a</name><label kind="invariant">x &lt; 3</label></location>'
    text = message(document('', template('P', '', '', place, 'a', ''), 'system P;'))
    assert "a location label of kind 'invariant' is outside" in text
    branch = location('a') + '<branchpoint id="b"/>'
    text = message(document('', template('P', '', '', branch, 'a', ''), 'system P;'))
    assert 'branch points are outside the supported subset' in text


@pytest.mark.parametrize(
    ('formula', 'expected'),
    [
        ('E<> Q.a', "q.q:7: there is no process 'Q'; known are P"),
        ('E<> P.b', "q.q:7: P has no location or variable 'b'"),
        ('E<> P.', 'q.q:7: syntax error: the text ends too early'),
        ('E<> x', "q.q:7: 'x' is not declared"),
        ('E<> P.a = 1', 'q.q:7: '),
        ('P.a', 'q.q:7: syntax error: the text ends too early'),
        ('sup: P.a', 'q.q:7: sup queries are outside the supported subset'),
        ('A[] P.f() == 1', 'q.q:7: f is called from outside its process; declare the function'),
        ('Pr[<=3](<> P.a)', 'q.q:7: statistical queries are outside the supported subset'),
    ],
)
def test_wrong_query(formula: str, expected: str) -> None:
    model = single('a\na -> a', local='int f() { return 1; }')
    (query,) = read_queries('\n' * 6 + formula, 'q.q')
    with pytest.raises(ModelFormatError) as caught:
        check(model, [query])
    assert str(caught.value).startswith(expected)


def test_query_file_with_comments_and_continuations() -> None:
    text = """/*
first
comment */
E<> P.a // why

// second
A[] P.a and \\
    true
A[] (P.a
  or true)
"""
    queries = read_queries(text, 'q.q')
    assert [(q.formula, q.comment, q.place.line if q.place else 0) for q in queries] == [
        ('E<> P.a', 'first comment why', 4),
        ('A[] P.a and true', 'second', 7),
        ('A[] (P.a or true)', '', 9),
    ]
    assert verdicts(single('a\na -> a'), *(q.formula for q in queries)) == ['satisfied'] * 3


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('', 'q.q: the file has no query'),
        ('// nothing', 'q.q: the file has no query'),
        ('/* open\nE<> a', 'q.q:2: a comment is not closed'),
        ('E<> (a', 'q.q:1: the last query is not complete'),
        ('\0', 'q.q: the file is binary, not text'),
    ],
)
def test_wrong_query_file(text: str, expected: str) -> None:
    with pytest.raises(ModelFormatError) as caught:
        read_queries(text, 'q.q')
    assert str(caught.value).startswith(expected)


def test_queries_of_the_model_keep_comment_and_line() -> None:
    query = '\n<query><formula>\nE&lt;&gt; P.a</formula><comment>words</comment></query>'
    model = read_model(document('', TEMPLATE, 'system P;', query), 'm.xml')
    (found,) = model.queries
    assert isinstance(found, Query)
    assert (found.formula, found.comment) == ('E<> P.a', 'words')
    assert found.place is not None
    assert found.place.line == 12


@pytest.mark.parametrize('engine', ENGINES)
@pytest.mark.parametrize(
    ('update', 'expected'),
    [
        ('x = x + 1', 'm.xml:7: 4 is outside the range 0..3 of x'),
        ('x++', 'm.xml:7: 4 is outside the range 0..3 of x'),
        ('y = a[x], x = 3', 'm.xml:7: index 3 is outside a, which has 3 elements'),
        ('a[x] = 1, x++', 'm.xml:7: index 3 is outside a, which has 3 elements'),
        ('y = 1 / (x - 3), x = 3', 'm.xml:7: division by zero'),
        ('y = 2 % z', 'm.xml:7: division by zero'),
        ('y = 1 << (5 % (on == 2))', 'm.xml:7: division by zero'),
        ('x = 3, y = 1 << (x * 11)', 'm.xml:7: shift by 33 bits'),
        ('y = 30000, y += y', 'm.xml:7: 60000 is outside the range -32768..32767 of y'),
        ('y = 2000, y = y * y * y / 2', 'm.xml:7: 8000000000 does not fit into 32 bits'),
        ('y = endless()', 'm.xml:3: endless runs through more than 1000000 loop passes'),
        ('y = deep()', 'm.xml:3: deep runs through more than 1000000 loop passes'),
        ('y = many40(z)', 'm.xml:3: many0 runs through more than 1000000 loop passes and calls'),
        ('y = partial(z)', 'm.xml:3: partial ended without return'),
        ('y = narrow(9)', 'm.xml:7: 9 is outside the range 0..3 of parameter n of narrow'),
    ],
)
def test_run_time_errors_have_a_place(update: str, expected: str, engine: EngineKind) -> None:
    declaration = (
        'int[0, 3] x; int y, z; int a[3]; bool on;'
        'int endless() { while (true) { y = y; } return 1; }'
        'int deep() { int n; for (i : int[0, 9999]) for (j : int[0, 9999]) n = j; return n; }'
        'int partial(int n) { if (n > 0) return 1; }'
        'int narrow(int[0, 3] n) { return n; }'
        'int many0(int n) { int k = n; k++; return k - 1; }'
    )
    for k in range(1, 41):
        twice = f'many{k - 1}(n) + many{k - 1}(n)'
        declaration += f'int many{k}(int n) {{ return {twice} <? 0; }}'
    model = None
    with pytest.raises(ModelFormatError) as caught:
        model = single(f'a\na -> a; do: {update}', declaration)
        ask(model, 'A[] not deadlock', engine=engine)
    assert str(caught.value).startswith(expected)


@pytest.mark.parametrize('engine', ENGINES)
def test_channel_index_out_of_range_is_an_error_even_without_receivers(
    engine: EngineKind,
) -> None:
    for prefix in ('', 'broadcast '):
        model = single('a\na -> a; sync: c[x]!', f'{prefix}chan c[2]; int x = 2;')
        with pytest.raises(ModelFormatError, match='index 2 is outside c'):
            ask(model, 'A[] not deadlock', engine=engine)


COUNTER = 'a\n' + '\n'.join(f'a -> a; do: b[{i}] = !b[{i}]' for i in range(40))


@pytest.mark.parametrize('engine', ENGINES)
@pytest.mark.parametrize(
    ('limits', 'reason'),
    [
        (Limits(states=5000), 'the limit of 5000 states was reached'),
        (Limits(seconds=0.05), 'the limit of 0.05 s was reached'),
        (Limits(memory_mb=1), 'the limit of 1 MB was reached'),
    ],
)
def test_limit_leaves_queries_undecided(limits: Limits, reason: str, engine: EngineKind) -> None:
    model = single(COUNTER, 'bool b[40];')
    result = ask(
        model, 'A[] not deadlock', 'b[0] --> b[1]', engine=engine, limits=limits, reduction=False
    )
    words = [(answer.verdict.value, answer.reason) for answer in result.answers]
    assert words[0] == ('undecided', reason)
    assert words[1][0] in ('undecided', 'not satisfied')
    assert not result.complete


@pytest.mark.parametrize('engine', ENGINES)
def test_limit_beyond_all_numbers_is_no_limit(engine: EngineKind) -> None:
    model = single('a b\na -> b')
    assert verdicts(model, 'E<> P.b', engine=engine, limits=Limits(states=10**30)) == ['satisfied']


@pytest.mark.parametrize('engine', ENGINES)
def test_early_answers_survive_a_limit(engine: EngineKind) -> None:
    model = single(COUNTER, 'bool b[40];')
    result = ask(
        model,
        'E<> b[3] and b[5]',
        'A[] not b[7]',
        'A[] b[0] or !b[0]',
        engine=engine,
        limits=Limits(states=20000),
        reduction=False,
    )
    assert [a.verdict.value for a in result.answers] == ['satisfied', 'not satisfied', 'undecided']
    assert [len(a.path.steps) if a.path else 0 for a in result.answers] == [2, 1, 0]


@pytest.mark.parametrize('engine', ENGINES)
def test_search_ends_when_everything_is_answered(engine: EngineKind) -> None:
    result = ask(single(COUNTER, 'bool b[40];'), 'E<> b[3]', engine=engine)
    assert result.answers[0].verdict.value == 'satisfied'
    assert result.states < 2000
    assert not result.complete


def test_interrupt_answers_with_what_is_known() -> None:
    model = single(COUNTER, 'bool b[40];')

    def interrupt(progress: object) -> None:
        if getattr(progress, 'states') > 2000:  # noqa: B009 - any engine's progress
            raise KeyboardInterrupt

    for engine in ENGINES:
        result = check(
            model,
            [Query('E<> b[3]', '', None), Query('A[] not deadlock', '', None)],
            engine=engine,
            reduction=False,
            progress=interrupt,
        )
        verdict = [(a.verdict.value, a.reason) for a in result.answers]
        assert verdict == [('satisfied', None), ('undecided', 'interrupted')]


def test_state_view_evaluates_in_the_scope_of_a_process() -> None:
    process = automaton(
        'P',
        'a b\na -> b; select: i : int[2, 2]; do: n = id + i; say: {n} goes',
        parameters='const int[0, 5] id',
        local='int[0, 9] n; int twice() { return 2 * n; }',
    )
    model = network(process, declaration='int g = 7;', system='A = P(3); B = P(1); system A, B;')
    path = ask(model, 'E<> A.b').answers[0].path
    assert path is not None
    (step,) = path.steps
    (taken,) = step.edges
    assert (taken.process, taken.template, taken.comment) == ('A', 'P', '{n} goes')
    assert (taken.source, taken.target, taken.channel) == ('a', 'b', None)
    assert (dict(taken.select), taken.place.file) == ({'i': 2}, 'm.xml')
    assert step.state.evaluate('n', 'A') == 5
    assert step.state.evaluate('twice() + id + g', 'A') == 20
    assert step.state.evaluate('B.n + g') == 7
    assert dict(step.state.variables) == {'g': 7, 'A.n': 5, 'B.n': 0}
    assert dict(step.state.locations) == {'A': 'b', 'B': 'a'}
    with pytest.raises(ModelFormatError, match="'nobody' is not declared"):
        step.state.evaluate('nobody', 'A')
