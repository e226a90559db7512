"""The execution trace of real executors: it follows rclpy's own rules, and shows in Perfetto."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest
from conftest import EXAMPLES

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.run import run_command

PROGRAMS = Path(__file__).with_name('programs')
Lines = Sequence[Mapping[str, Any]]


def trace_of(
    program: Path, arguments: Sequence[str], env: Mapping[str, str], folder: Path, python: str
) -> Lines:
    trace = folder / 'run.jsonl'
    status = run_command(
        [python, str(program), *arguments],
        folder / 'live.yaml',
        io.StringIO(),
        trace=trace,
        environment=env,
    )
    assert status == 0
    return [json.loads(line) for line in trace.read_text().splitlines()]


@pytest.fixture
def two_groups(rclpy_python: str, ros_env: dict[str, str], tmp_path: Path) -> Lines:
    node = EXAMPLES / 'two_groups' / 'node.py'
    return trace_of(node, ['--seconds', '1.5'], ros_env, tmp_path, rclpy_python)


def events_of(lines: Lines, name: str) -> list[str]:
    (number,) = [
        line['entity'] for line in lines if 'kind' in line and line['name'].endswith(f'.{name}')
    ]
    return [line['event'] for line in lines if 'event' in line and line['entity'] == number]


def test_callback_is_collected_begun_taken_ended(two_groups: Lines) -> None:
    steps = events_of(two_groups, 'plan')
    assert steps[:4] == ['collect', 'begin', 'take', 'end']


def test_two_members_of_an_exclusive_group_never_overlap(two_groups: Lines) -> None:
    groups = {line['entity']: line['group'] for line in two_groups if 'kind' in line}
    depth: dict[int, int] = {}
    for line in two_groups:
        if line.get('event') in ('begin', 'end'):
            group = groups[line['entity']]
            depth[group] = depth.get(group, 0) + (1 if line['event'] == 'begin' else -1)
            assert depth[group] in (0, 1)
    assert len(depth) == 2


def test_trace_for_perfetto_has_a_track_for_each_thread_and_group(
    two_groups: Lines, tmp_path: Path
) -> None:
    (header,) = [line for line in two_groups if 'format' in line]
    events = json.loads((tmp_path / 'run.perfetto.json').read_text())['traceEvents']
    names = {event['args']['name'] for event in events if event['name'] == 'thread_name'}
    assert set(header['threads'].values()) <= names
    drawn = {event['tid'] for event in events if event['ph'] == 'X' and event['pid'] < 0}
    assert len(drawn) == 2


def test_work_outside_every_group_is_traced(
    rclpy_python: str, ros_env: dict[str, str], tmp_path: Path
) -> None:
    program = PROGRAMS / 'everything_hidden.py'
    lines = trace_of(program, [], ros_env, tmp_path, rclpy_python)
    assert events_of(lines, 'work_later') == ['task', 'run', 'pause']
    assert events_of(lines, 'on_answer') == ['task', 'run', 'pause']


def test_trace_into_a_directory_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='is a directory; name a file for the trace'):
        run_command(['true'], tmp_path / 'live.yaml', io.StringIO(), trace=tmp_path)
