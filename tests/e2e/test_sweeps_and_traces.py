"""Sweeps of thread counts, and runs written for other viewers."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.e2e.conftest import EXAMPLES, Run

CASE_2 = EXAMPLES / 'paper_case2' / 'node.py'


def test_a_sweep_says_from_how_many_threads_on_a_verdict_turns(run: Run) -> None:
    outcome = run('verify', CASE_2, '--threads', '1..3')
    assert outcome.status == 0
    assert outcome.out.splitlines()[-2:] == [
        '  from 2 threads on:',
        '    satisfied -> not satisfied: starvation 25-26',
    ]


def test_a_sweep_over_one_thread_says_why_all_columns_are_alike(run: Run) -> None:
    node = EXAMPLES / 'default_group_only' / 'node.py'
    outcome = run('verify', node, '--profile', 'rclpy', '--threads', '1..3')
    assert outcome.out.splitlines()[-1] == (
        '  note: SingleThreadedExecutor runs callbacks on one thread, for any number given; '
        'to try a pool, write kind: MultiThreadedExecutor into the specification'
    )


def test_a_sweep_as_json_is_a_list_in_the_order_of_the_table(run: Run) -> None:
    outcome = run(
        'verify', CASE_2, '--threads', '1..2', '--max-cycle', '1..2', '--output-format', 'json'
    )
    data = json.loads(outcome.out)
    assert [(point['threads'], point['max_cycle']) for point in data] == [
        (1, 1),
        (2, 1),
        (1, 2),
        (2, 2),
    ]


@pytest.mark.parametrize('bad', ['0', '3..1', 'x', '1..', '-1'])
def test_a_range_that_is_none_is_refused(run: Run, bad: str) -> None:
    outcome = run('verify', CASE_2, f'--threads={bad}')
    assert outcome.status == 2
    assert 'argument --threads' in outcome.err


@pytest.mark.parametrize(
    ('form', 'suffix', 'begin'),
    [
        ('text', '.txt', 'group group is always open'),
        ('json', '.json', '['),
        ('mermaid', '.mmd', '---\ntitle:'),
        ('perfetto', '.trace.json', '{'),
        ('uppaal', '.xml', '<?xml'),
        ('xtr', '.xtr', '0 0 '),
    ],
)
def test_each_run_becomes_a_file(
    run: Run, tmp_path: Path, form: str, suffix: str, begin: str
) -> None:
    outcome = run('verify', CASE_2, '--trace-format', form, '-o', 'traces')
    assert outcome.status == 0
    files = sorted((tmp_path / 'traces').iterdir())
    assert [file.name for file in files] == [
        f'paper_case2_{number:03}{suffix}' for number in (22, 23, 24, 25, 26)
    ]
    text = files[0].read_text()
    assert text.startswith(begin)
    if suffix.endswith('json'):
        json.loads(text)
