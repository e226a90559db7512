"""What ``run --trace`` writes is read back; anything else is refused in one line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from ros2cc_extract.conform.trace import Event, Subject, Trace, read_traces
from ros2cc_extract.errors import InputError

HEADER: dict[str, Any] = {
    'format': 'ros2cc trace',
    'version': 1,
    'process': 7,
    'rclpy': '9.1.2',
    'lost': 2,
    'threads': {'100': 'spin'},
}
SUBJECT: dict[str, Any] = {
    'process': 7,
    'entity': 3,
    'kind': 'timer',
    'node': 'arm',
    'group': 9,
    'executor': 1,
    'name': 'arm.tick',
    'key': None,
}
EVENT: dict[str, Any] = {
    'process': 7,
    'clock_ns': 5,
    'thread': 100,
    'event': 'begin',
    'entity': 3,
}


def write(path: Path, *lines: dict[str, Any]) -> Path:
    path.write_text(''.join(json.dumps(line) + '\n' for line in lines))
    return path


def test_a_trace_is_read_as_it_was_written(tmp_path: Path) -> None:
    path = write(tmp_path / 'run.jsonl', HEADER, SUBJECT, EVENT)
    subject = Subject(3, 'timer', 'arm', 9, 1, 'arm.tick', None)
    (trace,) = read_traces(path)
    assert trace == Trace(7, '9.1.2', 2, {100: 'spin'}, {3: subject}, (Event(5, 100, 'begin', 3),))
    assert (trace.subjects, trace.events) == ({3: subject}, (Event(5, 100, 'begin', 3),))


def test_each_process_has_its_own_trace(tmp_path: Path) -> None:
    second = {**HEADER, 'process': 8, 'lost': 0}
    of_second = [{**line, 'process': 8} for line in (SUBJECT, EVENT, EVENT)]
    path = write(tmp_path / 'run.jsonl', HEADER, SUBJECT, second, *of_second, EVENT)
    counted = [(t.process, t.lost, len(t.subjects), len(t.events)) for t in read_traces(path)]
    assert counted == [(7, 2, 1, 1), (8, 0, 1, 2)]


def test_executors_in_the_order_of_their_making(tmp_path: Path) -> None:
    made = [
        {**SUBJECT, 'entity': n, 'kind': 'executor', 'name': name} for n, name in enumerate('ba')
    ]
    (trace,) = read_traces(write(tmp_path / 'run.jsonl', HEADER, SUBJECT, *made))
    assert [each.name for each in trace.executors()] == ['b', 'a']


OTHER = ' has a value of another type'
MEND = '; record it with: ros2cc-extract run --trace FILE -- COMMAND'


@pytest.mark.parametrize(
    ('lines', 'told'),
    [
        ([], ': is no trace: no line of a process'),
        ([SUBJECT, EVENT], ': is no trace: no line of a process'),
        ([{**HEADER, 'format': 'another'}], ': is a another 1, not a ros2cc trace 1'),
        ([{**HEADER, 'version': 2}], ': is a ros2cc trace 2, not a ros2cc trace 1'),
        ([{'format': 'ros2cc trace'}], ": is a damaged trace: 'version' is missing"),
        ([HEADER, {'event': 'begin'}], ": is a damaged trace: 'process' is missing"),
        ([HEADER, {**EVENT, 'clock_ns': None}], f": is a damaged trace: 'clock_ns'{OTHER}"),
        ([HEADER, {**EVENT, 'thread': '100'}], f": is a damaged trace: 'thread'{OTHER}"),
        ([HEADER, {**EVENT, 'entity': 1.5}], f": is a damaged trace: 'entity'{OTHER}"),
        ([HEADER, {**EVENT, 'event': 3}], f": is a damaged trace: 'event'{OTHER}"),
        ([HEADER, {**SUBJECT, 'entity': 'x'}], f": is a damaged trace: 'entity'{OTHER}"),
        ([{**HEADER, 'threads': ['spin']}], f": is a damaged trace: 'threads'{OTHER}"),
        ([{**HEADER, 'threads': {'x': 'y'}}], f": is a damaged trace: 'threads'{OTHER}"),
        ([{**HEADER, 'process': [7]}], f": is a damaged trace: 'process'{OTHER}"),
    ],
)
def test_something_else_is_refused(tmp_path: Path, lines: list[dict[str, Any]], told: str) -> None:
    path = write(tmp_path / 'run.jsonl', *lines)
    with pytest.raises(InputError) as raised:
        read_traces(path)
    assert str(raised.value) == f'{path}{told}{MEND}'


@pytest.mark.parametrize('line', [b'[1, 2]', b'{"process": 7', b'3'])
def test_a_line_that_is_no_object_is_told_by_its_number(tmp_path: Path, line: bytes) -> None:
    path = tmp_path / 'run.jsonl'
    path.write_bytes(json.dumps(HEADER).encode() + b'\n' + line + b'\n')
    with pytest.raises(InputError, match=r'run\.jsonl:2: is no line of a trace; record it with'):
        read_traces(path)


def test_what_is_no_text_and_what_is_not_there(tmp_path: Path) -> None:
    (tmp_path / 'image.jsonl').write_bytes(b'\x89PNG\xff')
    told = []
    for name in ('image.jsonl', 'nowhere.jsonl'):
        with pytest.raises(InputError) as raised:
            read_traces(tmp_path / name)
        told.append(str(raised.value).removeprefix(f'{tmp_path}/'))
    assert told == [
        f'image.jsonl: is no trace (no UTF-8 text){MEND}',
        'nowhere.jsonl: cannot be read: No such file or directory',
    ]
