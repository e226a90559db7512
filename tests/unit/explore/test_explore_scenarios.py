"""What is written of a failure, read again; and what is reported of it."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from ros2cc_extract.confirm.processes import Stimulus
from ros2cc_extract.errors import InputError
from ros2cc_extract.explore.exploring import Exploration
from ros2cc_extract.explore.failures import Failure, Kind, exception, lost_update
from ros2cc_extract.explore.points import Point
from ros2cc_extract.explore.replaying import TAILS, Replay, replay, schedules_of
from ros2cc_extract.explore.scenario import Found, Scenario, read_found, write_found
from ros2cc_extract.explore.watching import Process, Seen
from ros2cc_extract.explore.wording import (
    as_json,
    file_name,
    found_as_text,
    limits_of,
    replay_as_text,
    summary,
)

FAILURE = Failure(kind=Kind.LOST_UPDATE, file='/nowhere/arm.py', line=9, words='n was 1')
CHOICES = (('a#1', 'begin'), ('b#1', 'begin'), ('b#1', 'arm.py:9 write n'))
FOUND = Found(
    failure=FAILURE,
    schedule={'number': 3, 'policy': 'pct', 'seed': '1/3'},
    number=3,
    tail=CHOICES[1:],
    choices=CHOICES,
)
SCENARIO = Scenario(
    command=('python', 'arm.py'),
    stimulus=Stimulus(values=('go', 1.5), at_once=3, defaults=False),
    points=(Point(file='/nowhere/arm.py', line=9, kind='access', name='Arm.n', rests=True),),
    everywhere=True,
)


def test_reading_what_was_written_is_the_identity(tmp_path: Path) -> None:
    path = tmp_path / 'found.json'
    path.write_text(write_found(FOUND, SCENARIO, '7.1.6'), encoding='utf-8')
    assert read_found(path) == (SCENARIO, FOUND)


def changed(**parts: Any) -> str:
    row = json.loads(write_found(FOUND, SCENARIO, None))
    return json.dumps({**row, **parts})


@pytest.mark.parametrize(
    'text',
    [
        *('', '[]', '{}', '{"ros2cc_explore": 2}', '{"ros2cc_explore": 1}'),
        changed(command=[]),
        changed(command='python arm.py'),
        changed(tail=[['a', 'b', 'c']]),
        changed(failure={'kind': 'luck'}),
        changed(schedule={'seed': 1}),
        changed(schedule='pct'),
        changed(points=[{'file': 1, 'colour': 'red'}]),
    ],
)
def test_what_is_no_such_file_is_refused(text: str, tmp_path: Path) -> None:
    path = tmp_path / 'found.json'
    path.write_text(text, encoding='utf-8')
    with pytest.raises(InputError, match='is no schedule that explore has written'):
        read_found(path)


def test_a_file_that_is_not_there_is_said_so(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='cannot be read: No such file'):
        read_found(tmp_path / 'gone.json')


def test_a_failure_is_told_with_its_order_and_how_to_repeat_it() -> None:
    assert found_as_text(replace(FOUND, times=2), Path('out/1.json')) == (
        '/nowhere/arm.py:9: lost update: n was 1\n'
        '  schedule 3, in this order:\n'
        '    b#1: begin\n'
        '    b#1: arm.py:9 write n\n'
        '  seen in 2 schedules\n'
        '  repeat: ros2cc-extract explore --replay out/1.json\n'
    )
    assert file_name(FOUND, 1) == '1-lost-update-arm-9.json'


def test_of_a_long_order_both_ends_are_shown() -> None:
    tail = tuple((f'a#{number}', 'begin') for number in range(40))
    shown = found_as_text(replace(FOUND, tail=tail), None).splitlines()
    assert shown[2] == '    a#0: begin' and shown[-1] == '    a#39: begin'
    assert '    … 24 steps' in shown and len(shown) == 2 + 17


def test_the_plain_run_has_no_order() -> None:
    plain = replace(FOUND, schedule={'number': 0, 'policy': 'plain'}, tail=(), choices=())
    assert 'when the program ran as it came' in found_as_text(plain, None)
    assert schedules_of(plain) == [{'number': 1, 'policy': 'plain', 'seconds': 3.0}]


def test_words_of_the_program_do_nothing_to_the_terminal() -> None:
    nasty = replace(FAILURE, words='\x1b[2J gone')
    assert '\x1b' not in found_as_text(replace(FOUND, failure=nasty), None)


def test_the_last_line_counts() -> None:
    so_far = Exploration([FOUND], done=12, processes=3, begins=40, why_ended='the time is over')
    assert summary(so_far, 61.4) == (
        '1 failure in 12 schedules and a plain run, 40 callbacks begun, 3 processes, 61 s: '
        'the time is over'
    )
    row = json.loads(as_json(so_far, {}, seconds=61.4, release='7.1.6', limits=['a limit']))
    assert row['failures'][0] == {
        'kind': 'lost update',
        'path': '/nowhere/arm.py',
        'line': 9,
        'what': 'n was 1',
        'evidence': '',
        'schedule': 3,
        'policy': 'pct',
        'seed': '1/3',
        'times': 1,
        'order': [['b#1', 'begin'], ['b#1', 'arm.py:9 write n']],
        'file': None,
    }
    assert (row['limits'], row['schedules'], row['rclpy']) == (['a limit'], 12, '7.1.6')


def test_what_was_not_looked_at_is_said() -> None:
    assert limits_of(Exploration(begins=1), points=2, sources=1) == []
    assert limits_of(Exploration(), points=0, sources=0) == [
        'no source was scanned: callbacks are ordered, but none is held inside',
        'no callback of the program began, or none that its group is asked for',
    ]


def test_an_exception_counts_where_the_program_has_a_part_in_it() -> None:
    frames = [['/nowhere/arm.py', 7, 'step'], ['/usr/lib/python3.11/json/decoder.py', 3, 'decode']]
    row = {'type': 'ValueError', 'text': 'no JSON', 'frames': frames, 'choices': [1, 2]}
    found = exception(row)
    assert found is not None
    assert (found.file, found.line, found.words, found.step) == (
        *('/nowhere/arm.py', 7, 'ValueError: no JSON', 2),
    )
    assert exception({**row, 'frames': frames[1:]}) is None
    assert exception({**row, 'type': 'ExternalShutdownException'}) is None


def test_a_lost_update_is_told_by_its_values() -> None:
    row = {'name': 'Arm.n', 'file': 'arm.py', 'line': 9, 'read_line': 7, 'choices': []}
    found = lost_update({**row, 'read': '1', 'other': '5', 'own': '2'})
    assert found.words == (
        'n was 1 when line 7 had read it, another thread set it to 5, and line 9 then to 2'
    )


def test_all_of_a_schedule_comes_first_in_every_other_process() -> None:
    lengths = [[len(row['choices']) for row in schedules_of(FOUND, n)] for n in (1, 2, 3)]
    assert lengths == [[2] * TAILS + [3], [3] + [2] * TAILS, [2] * TAILS + [3]]


def test_a_replay_ends_with_the_failure() -> None:
    tried: list[int] = []

    def run(rows: Any, until: Any) -> Process:
        tried.append(len(rows))
        last = Seen(rows[1], failures=[FAILURE] if len(tried) == 2 else [])
        return Process(schedules=[Seen(rows[0]), last])

    result = replay(FOUND, run)
    assert tried == [TAILS + 1] * 2
    assert (result.failure, result.processes, result.tries) == (FAILURE, 2, 4)
    assert 'lost update repeated in' in replay_as_text(FOUND, result)
    not_seen = Replay(None, 3, 18, 20.0)
    assert replay_as_text(FOUND, not_seen) == (
        '/nowhere/arm.py:9: lost update was not seen again in 20 s, in 18 tries of 3 processes\n'
    )
