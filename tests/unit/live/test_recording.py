"""Reading recordings and traces, whole and damaged ones."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.events import loss, thread_name
from ros2cc_extract.extract.live.recording import read_recording
from ros2cc_extract.extract.live.trace import Event, read_trace, to_chrome, write_lines
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
    assert read.events == (
        Event(90, 11, 'collect', 4),
        Event(100, 11, 'begin', 4),
        Event(130, 12, 'end', 4),
    )
    assert (read.threads, read.lost) == ({11: 'MainThread'}, 1)


def test_name_cut_off_hides_nothing_before_it(tmp_path: Path) -> None:
    cut = thread_name(12, 'ThreadPoolExecutor-0_0')[:-3]
    read = trace(recording(tmp_path), event(100, 11, 'begin', 4), cut)
    assert read.events == (Event(100, 11, 'begin', 4),)


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


def test_stretch_is_drawn_on_its_thread_and_its_group(tmp_path: Path) -> None:
    recorded = recording(
        tmp_path,
        nodes=[node(2, 'arm')],
        groups=[group(3, node=2, default=True)],
        entities=[timer(4, 2, 3, 'arm.Arm.tick')],
    )
    events = to_chrome([trace(recorded, *TRACE)])['traceEvents']
    drawn = [(e['pid'], e['tid'], e['name'], e['dur']) for e in events if e['ph'] == 'X']
    assert drawn == [(7, 11, 'tick', 0.03), (-7, 3, 'tick', 0.03)]
    names = {e['args']['name'] for e in events if e['ph'] == 'M'}
    assert {'MainThread', 'default group of arm (exclusive)'} <= names


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
    drawn = [e for e in to_chrome([trace(recorded, *PAUSED)])['traceEvents'] if e['ph'] == 'X']
    assert [(e['pid'], e['tid'], e['name'], e['ts'], e['dur']) for e in drawn] == [
        (7, 11, 'tick', 0.1, 0.01),
        (7, 11, '? waits', 0.12, 0.03),
        (7, 12, 'tick', 0.16, 0.02),
        (-7, 3, 'tick', 0.1, 0.08),
    ]
