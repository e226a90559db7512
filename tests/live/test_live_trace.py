"""The execution trace of real executors: it follows rclpy's own rules, and shows in Perfetto."""

from __future__ import annotations

import io
import json
import signal
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest
from child import Child
from conftest import EXAMPLES
from recorded import recordings_in

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.recordings.trace import read_trace
from ros2cc_extract.extract.live.run import collect_directory, run_command
from ros2cc_extract.spec.yaml.yaml_io import load_specs

PROGRAMS = Path(__file__).with_name('programs')
Lines = Sequence[Mapping[str, Any]]


def trace_of(program: Path, env: Mapping[str, str], folder: Path, python: str) -> Lines:
    trace = folder / 'run.jsonl'
    status = run_command(
        [python, str(program)],
        folder / 'live.yaml',
        io.StringIO(),
        trace=trace,
        environment=env,
    )
    assert status == 0
    return [json.loads(line) for line in trace.read_text().splitlines()]


@pytest.fixture
def two_groups(start: Callable[..., Child], tmp_path: Path) -> Lines:
    """Trace an example until it has planned twice; its other timer is ten times as fast."""
    folder, trace = tmp_path / 'recordings', tmp_path / 'run.jsonl'
    folder.mkdir()
    node = EXAMPLES / 'two_groups' / 'node.py'
    child = start(node, recorded_into=folder, traced=True)
    child.read_until(lambda lines: sum('planned' in line for line in lines) == 2)
    child.end_well(signal.SIGINT)
    stderr = io.StringIO()
    assert collect_directory(folder, tmp_path / 'live.yaml', stderr, trace=trace) == 0
    return [json.loads(line) for line in trace.read_text().splitlines()]


def events_of(lines: Lines, name: str) -> list[str]:
    (number,) = [
        line['entity'] for line in lines if 'kind' in line and line['name'].endswith(f'.{name}')
    ]
    return [line['event'] for line in lines if 'event' in line and line['entity'] == number]


def test_callback_is_collected_begun_taken_ended(two_groups: Lines) -> None:
    steps = events_of(two_groups, 'plan')
    assert steps[:5] == ['collect', 'submit', 'begin', 'take', 'end']


@pytest.mark.usefixtures('two_groups')
def test_executor_is_made_where_the_program_makes_it(tmp_path: Path) -> None:
    (unit,) = load_specs(tmp_path / 'live.yaml')
    assert unit.executor.source is not None
    assert unit.executor.source.file.endswith('two_groups/node.py')


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
    named = [event for event in events if event['name'] == 'process_name']
    (groups,) = [event['pid'] for event in named if 'groups' in event['args']['name']]
    assert len({e['tid'] for e in events if e['ph'] == 'X' and e['pid'] == groups}) == 2
    assert nested_or_apart(events)


def nested_or_apart(events: Sequence[Mapping[str, Any]]) -> bool:
    """Whether slices of one track are one inside the other, or one after the other."""
    ends: dict[Any, list[int]] = {}
    shown = [event for event in events if event['ph'] == 'X']
    for event in sorted(shown, key=lambda e: (e['ts'], -e['dur'])):
        begin = round(event['ts'] * 1000)
        end = begin + round(event['dur'] * 1000)
        around = ends.setdefault((event['pid'], event['tid']), [])
        while around and around[-1] <= begin:
            around.pop()
        if around and end > around[-1]:
            return False
        around.append(end)
    return True


def test_work_outside_every_group_is_traced(
    rclpy_python: str, ros_env: dict[str, str], tmp_path: Path
) -> None:
    program = PROGRAMS / 'everything_hidden.py'
    lines = trace_of(program, ros_env, tmp_path, rclpy_python)
    assert events_of(lines, 'work_later') == ['task', 'run', 'pause']
    assert events_of(lines, 'on_answer') == ['task', 'run', 'pause']


def test_executor_waits_and_is_woken_in_turn(two_groups: Lines) -> None:
    (executor,) = [line for line in two_groups if line.get('kind') == 'executor']
    assert (executor['name'], executor['threads']) == ('MultiThreadedExecutor', 2)
    number = executor['entity']
    steps = [x['event'] for x in two_groups if 'event' in x and x['entity'] == number]
    assert steps[:4] == ['wait>', 'wait<', 'wait>', 'wait<']
    assert set(zip(steps[::2], steps[1::2], strict=False)) == {('wait>', 'wait<')}


def test_waits_of_each_process_are_traced(start: Callable[..., Child], tmp_path: Path) -> None:
    child = start(PROGRAMS / 'forking.py', recorded_into=tmp_path, traced=True)
    assert child.end() == 4, child.text
    traces = [read_trace(recording) for recording in recordings_in(tmp_path)]
    waited = ['wait>' in {event.event for event in trace.events()} for trace in traces if trace]
    assert waited == [True] * 3


def test_coroutine_is_suspended_and_resumed_once_however_often_it_is_asked(
    rclpy_python: str, ros_env: dict[str, str], tmp_path: Path
) -> None:
    lines = trace_of(PROGRAMS / 'awaiting.py', ros_env, tmp_path, rclpy_python)
    steps = events_of(lines, 'await_readiness')
    assert steps == ['collect', 'submit', 'begin', 'take', 'suspend', 'resume', 'end']


def test_handler_that_another_thread_holds_is_not_paused(
    ros_env: Mapping[str, str], rclpy_python: str, tmp_path: Path
) -> None:
    lines = trace_of(PROGRAMS / 'called_in_vain.py', ros_env, tmp_path, rclpy_python)
    told = [line for line in lines if 'event' in line]
    assert {'begin', 'end'} <= {line['event'] for line in told}
    assert not [line for line in told if line['event'] in ('suspend', 'resume')]


def test_trace_into_a_directory_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='is a directory; name a file'):
        run_command(['true'], tmp_path / 'live.yaml', io.StringIO(), trace=tmp_path)
