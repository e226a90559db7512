"""Reading recordings and traces, whole and damaged ones."""

from __future__ import annotations

import io
import json
import time
from pathlib import Path
from typing import Any

import pytest

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.recorder.events import loss, thread_name
from ros2cc_extract.extract.live.recordings.recording import read_recording
from ros2cc_extract.extract.live.recordings.trace import Event, Trace, read_trace, write_lines
from ros2cc_extract.extract.live.recordings.trace_event_format import write_chrome
from tests.unit.live.recordings import data, event, group, node, recording, timer, trace


def test_places_below_the_folder_are_shown_relative_to_it(tmp_path: Path) -> None:
    created = [str(tmp_path / 'pkg' / 'arm.py'), 12, 9]
    recorded = recording(tmp_path, entities=[timer(4, 2, 3, 'arm.tick', created=created)])
    assert str(recorded.entities[0].created) == 'pkg/arm.py:12:9'


@pytest.mark.parametrize(
    ('text', 'complaint'),
    [
        ('{"format": ', 'is no recording (not JSON)'),
        ('{"format": "other"}', 'is no recording of a live process'),
        (json.dumps(data(version=2)), 'is a recording of version 2, not 1'),
        (json.dumps(data(nodes=[{}])), "is a damaged recording: KeyError('stays')"),
    ],
)
def test_file_that_is_no_recording_is_told(text: str, complaint: str, tmp_path: Path) -> None:
    path = tmp_path / 'odd.json'
    path.write_text(text, encoding='utf-8')
    with pytest.raises(InputError) as raised:
        read_recording(path, tmp_path)
    mend = 'record the process again with this version of the tool'
    assert str(raised.value) == f'{path}: {complaint}; {mend}'


TRACE = (
    thread_name(11, 'MainThread'),
    event(100, 11, 'begin', 4),
    event(90, 11, 'collect', 4),
    loss(),
    event(130, 12, 'end', 4),
    event(140, 11, 'begin', 4)[:-1],
)


def test_trace_is_ordered_and_a_cut_off_row_left_out(tmp_path: Path) -> None:
    read = trace(recording(tmp_path), *TRACE)
    assert tuple(read.events()) == (
        Event(90, 11, 'collect', 4),
        Event(100, 11, 'begin', 4),
        Event(130, 12, 'end', 4),
    )
    assert (read.threads, read.lost) == ({11: 'MainThread'}, 1)


def test_name_cut_off_hides_nothing_before_it(tmp_path: Path) -> None:
    cut = thread_name(12, 'ThreadPoolExecutor-0_0')[:-3]
    read = trace(recording(tmp_path), event(100, 11, 'begin', 4), cut)
    assert tuple(read.events()) == (Event(100, 11, 'begin', 4),)


def test_process_without_a_trace_has_none(tmp_path: Path) -> None:
    assert read_trace(recording(tmp_path)) is None


def test_exported_lines_tell_process_entities_events(tmp_path: Path) -> None:
    recorded = recording(
        tmp_path, nodes=[node(2, 'arm')], entities=[timer(4, 2, 3, 'arm.Arm.tick')]
    )
    stream = io.StringIO()
    write_lines([trace(recorded, *TRACE)], stream)
    header, entity, *events = map(json.loads, stream.getvalue().splitlines())
    assert (header['process'], header['lost']) == (7, 1)
    assert (entity['name'], entity['node'], entity['group']) == ('arm.Arm.tick', 'arm', 3)
    assert [event['event'] for event in events] == ['collect', 'begin', 'end']


def drawn(read: Trace) -> list[dict[str, Any]]:
    stream = io.StringIO()
    write_chrome([read], stream)
    return json.loads(stream.getvalue())['traceEvents']


def tracks(events: list[dict[str, Any]]) -> dict[tuple[int, int], str]:
    return {(e['pid'], e['tid']): e['args']['name'] for e in events if e['name'] == 'thread_name'}


def test_stretch_is_drawn_on_its_thread_and_its_group(tmp_path: Path) -> None:
    recorded = recording(
        tmp_path,
        nodes=[node(2, 'arm')],
        groups=[group(3, node=2, default=True)],
        entities=[timer(4, 2, 3, 'arm.Arm.tick')],
    )
    events = drawn(trace(recorded, *TRACE))
    names = tracks(events)
    assert [
        (names[e['pid'], e['tid']], e['name'], e['dur']) for e in events if e['ph'] == 'X'
    ] == [
        ('MainThread', 'tick', 0.03),
        ('default group of arm (exclusive)', 'tick', 0.03),
    ]
    processes = [e['args']['name'] for e in events if e['name'] == 'process_name']
    assert processes == ['threads of process 7', 'callback groups of process 7']


PAUSED = (
    event(100, 11, 'begin', 4),
    event(110, 11, 'suspend', 4),
    event(120, 11, 'wait>', 1),
    event(150, 11, 'wait<', 1),
    event(160, 12, 'resume', 4),
    event(180, 12, 'end', 4),
)


def test_paused_coroutine_leaves_its_thread_and_stays_in_its_group(tmp_path: Path) -> None:
    recorded = recording(tmp_path, groups=[group(3)], entities=[timer(4, 2, 3, 'arm.Arm.tick')])
    threads = thread_name(11, 'a'), thread_name(12, 'b')
    events = drawn(trace(recorded, *threads, *PAUSED))
    names = tracks(events)
    shown = [e for e in events if e['ph'] == 'X']
    assert [(names[e['pid'], e['tid']], e['name'], e['ts'], e['dur']) for e in shown] == [
        ('a', 'tick', 0.1, 0.01),
        ('a', '? waits', 0.12, 0.03),
        ('b', 'tick', 0.16, 0.02),
        ('group 3 (exclusive)', 'tick', 0.1, 0.08),
    ]


def test_a_run_in_vain_is_left_out(tmp_path: Path) -> None:
    read = trace(
        recording(tmp_path),
        event(100, 12, 'run', 5),
        event(110, 11, 'run', 4),
        event(120, 12, 'run', 4),
        event(130, 12, 'vain', 4),
        event(135, 12, 'resume', 6),
        event(136, 12, 'vain', 6),
        event(140, 11, 'pause', 4),
    )
    assert [(e.thread, e.event, e.subject) for e in read.events()] == [
        (12, 'run', 5),
        (11, 'run', 4),
        (11, 'pause', 4),
    ]


BIG, OTHER = 139644125758656, 139644125758657
OVERLAPPING = (
    thread_name(BIG, 'a'),
    thread_name(OTHER, 'b'),
    event(100, BIG, 'begin', 4),
    event(110, OTHER, 'begin', 4),
    event(130, BIG, 'end', 4),
    event(140, BIG, 'begin', 4),
    event(150, OTHER, 'end', 4),
    event(160, BIG, 'collect', 4),
)


def test_slices_of_one_track_never_overlap(tmp_path: Path) -> None:
    recorded = recording(tmp_path, groups=[group(3)], entities=[timer(4, 2, 3, 'arm.Arm.tick')])
    events = drawn(trace(recorded, *OVERLAPPING))
    names = tracks(events)
    shown = [e for e in events if e['ph'] in 'XB']
    assert [(names[e['pid'], e['tid']], e['ph'], e['ts']) for e in shown] == [
        ('a', 'X', 0.1),
        ('group 3 (exclusive)', 'X', 0.1),
        ('b', 'X', 0.11),
        ('group 3 (exclusive), number 2 at a time', 'X', 0.11),
        ('a', 'B', 0.14),
        ('group 3 (exclusive)', 'B', 0.14),
    ]


def test_numbers_of_tracks_are_those_that_perfetto_takes(tmp_path: Path) -> None:
    recorded = recording(tmp_path, groups=[group(3)], entities=[timer(4, 2, 3, 'arm.Arm.tick')])
    events = drawn(trace(recorded, *OVERLAPPING))
    assert all(0 < event[key] < 2**32 for event in events for key in ('pid', 'tid'))
    assert len(tracks(events)) == 4
    pids = {event['pid'] for event in events}
    assert len(pids) == 2
    assert pids.isdisjoint(tid for _, tid in tracks(events))


def test_lambda_is_called_by_what_it_serves(tmp_path: Path) -> None:
    timers = [timer(4, 2, 3, 'arm.Arm.__init__.<locals>.<lambda>')]
    recorded = recording(tmp_path, groups=[group(3)], entities=timers)
    (moment,) = [e for e in drawn(trace(recorded, *OVERLAPPING)) if e['ph'] == 'i']
    assert moment['name'] == 'collect <lambda> 0.5 s'


def test_order_is_found_however_far_apart_events_stand(tmp_path: Path) -> None:
    late = [event(10_000 + number, 11, 'begin', 4) for number in range(3000)]
    read = trace(recording(tmp_path), *late, event(5, 12, 'end', 4))
    clocks = [each.clock_ns for each in read.events()]
    assert (read.count, clocks) == (3001, sorted(clocks))


def test_steps_before_the_clock_began_are_put_in_order(tmp_path: Path) -> None:
    """Nobody's clock is negative; such a trace must end all the same."""
    read = trace(recording(tmp_path), event(-5, 7, 'begin', 4), event(-9, 7, 'end', 4))
    assert [each.clock_ns for each in read.events()] == [-9, -5]


def test_runs_that_never_end_have_a_lane_each(tmp_path: Path) -> None:
    recorded = recording(tmp_path, nodes=[node(2, 'arm')])
    many = 20_000
    begun = time.process_time()
    events = drawn(trace(recorded, *(event(n, 7, 'begin', 4) for n in range(many))))
    assert sum(e['ph'] == 'B' for e in events) >= many
    assert time.process_time() - begun < 10


@pytest.mark.parametrize(
    'changes',
    [
        {'number': 'four'},
        {'created': ['arm.py', 12]},
        {'created': ['arm.py', '12', 9]},
        {'function': {'name': 7, 'defined': None, 'coroutine': False}},
        {'function': []},
        {'measured': None},
        {'group': None},
        {'period_s': '0.5'},
    ],
)
def test_a_value_of_another_type_is_damage(changes: dict[str, object], tmp_path: Path) -> None:
    with pytest.raises(InputError, match='is a damaged recording'):
        recording(tmp_path, entities=[{**timer(4, 2, 3, 'arm.Arm.tick'), **changes}])
