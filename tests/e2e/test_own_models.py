"""Models that are not ours, and queries that a specification does not bring."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.e2e.conftest import EXAMPLES, Run

MODELS = Path(__file__).parents[1] / 'models'
CASE_2 = EXAMPLES / 'paper_case2' / 'node.py'


def verdicts(text: str) -> list[str]:
    """The verdict of each numbered row."""
    rows = [line for line in text.splitlines() if line[:3].strip().isdecimal() and ' s' in line]
    return ['no' if 'not satisfied' in row else 'yes' for row in rows if 'satisfied' in row]


@pytest.mark.parametrize(
    ('name', 'known'),
    [
        ('peterson', ['yes', 'yes', 'yes', 'yes', 'no']),
        ('philosophers', ['no', 'yes', 'yes', 'yes']),
        ('buffer', ['yes', 'yes', 'yes', 'no', 'yes']),
        ('fischer', ['no', 'yes', 'no', 'yes']),
    ],
)
def test_known_answers(run: Run, name: str, known: list[str]) -> None:
    outcome = run('verify', MODELS / f'{name}.xml')
    assert (outcome.status, verdicts(outcome.out)) == (0, known)


def test_a_deadlock_is_told_by_locations(run: Run) -> None:
    outcome = run('verify', MODELS / 'philosophers.xml')
    assert [line.strip() for line in outcome.out.splitlines()[-4:]] == [
        f'{n + 1}  Philosopher({n}): thinking -> has_one' for n in range(4)
    ]


def test_a_run_is_told_by_the_comments_of_the_model_and_says_whose_they_are(run: Run) -> None:
    outcome = run('verify', MODELS / 'buffer.xml', '--query', 'A[] used < 2 or Consumer.error')
    assert [line.strip() for line in outcome.out.splitlines()[-2:]] == [
        '1  Producer: puts a number',
        '2  Producer: puts a number',
    ]


def test_queries_given_replace_those_of_the_model(run: Run, tmp_path: Path) -> None:
    queries = tmp_path / 'my.q'
    queries.write_text('// both may wait\nE<> P0.waiting and P1.waiting\n')
    model = MODELS / 'peterson.xml'
    outcome = run('verify', model, queries, '--query', 'A[] P0.idle')
    assert verdicts(outcome.out) == ['yes', 'no']


def test_queries_without_words_stand_in_the_table_once(run: Run) -> None:
    outcome = run('verify', MODELS / 'peterson.xml', '--query', 'A[] P0.idle')
    head, row = outcome.out.splitlines()[1:3]
    assert head.split() == ['#', 'expression', 'verdict', 'time']
    assert row.count('A[] P0.idle') == 1


def test_a_specification_is_asked_other_queries_on_its_plain_text(run: Run) -> None:
    outcome = run('verify', CASE_2, '--query', 'A[] not (cb_running(0) and thread_running[1])')
    assert (outcome.status, verdicts(outcome.out)) == (0, ['no'])
    assert 'paper plain model' in outcome.out
    assert "PaperCase2.on_timer_a starts on thread_1; group 'group' closes" in outcome.out


def test_a_query_that_is_none_is_refused_by_its_place(run: Run) -> None:
    outcome = run('verify', CASE_2, '--query', 'A[] foo')
    assert outcome.status == 2
    assert "--query:1: 'foo' is not declared" in outcome.err


@pytest.mark.parametrize('form', ['xtr', 'uppaal'])
def test_a_run_that_uppaal_saved_is_told(run: Run, tmp_path: Path, form: str) -> None:
    written = run('verify', CASE_2, '--trace-format', form, '-o', 'runs')
    (saved,) = (tmp_path / 'runs').glob('*_026.*')
    told = run('verify', CASE_2, '--replay', saved)
    lines = told.out.splitlines()
    assert told.status == 0
    assert 'and then forever:' in told.out
    assert (
        ' '.join(lines[0].split())
        == '1 executor polls and sees PaperCase2.on_msg_d ready node.py:49'
    )
    assert all(line.strip() in written.out for line in lines)


def test_a_run_of_another_model_is_refused(run: Run, tmp_path: Path) -> None:
    run('verify', CASE_2, '--trace-format', 'uppaal', '-o', 'runs')
    (saved,) = (tmp_path / 'runs').glob('*_026.*')
    told = run('verify', MODELS / 'peterson.xml', '--replay', saved)
    assert told.status == 2
    assert 'the run does not begin in the initial state' in told.err


def test_a_sweep_does_not_pass_over_queries_that_were_given(run: Run) -> None:
    outcome = run('verify', CASE_2, '--threads', '1..2', '--query', 'A[] not deadlock')
    assert outcome.status == 2
    assert 'a sweep asks the queries of each model' in outcome.err
