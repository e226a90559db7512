"""The hook on real rclpy: it sees what there is to see, and the program does not notice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from child import Child
from conftest import ROOT
from recorded import PROGRAMS, recordings_in, written

from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.extract.live.recordings.recording import Recording
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import Callback, EntityKind, Spec, When
from ros2cc_extract.spec.yaml.yaml_io import read_specs, write_specs

Start = Callable[..., Child]
RunProgram = Callable[[str], 'Run']


@dataclass(frozen=True)
class Run:
    """How a program ended and what it said; with the hook also what was recorded of it."""

    status: int
    text: str
    recordings: tuple[Recording, ...] = ()

    @property
    def units(self) -> dict[str, Spec]:
        specs = (spec for recording in self.recordings for spec in specs_of(recording))
        return {spec.name: spec for spec in specs}


_RUNS: dict[str, Run] = {}


@pytest.fixture
def run(start: Start, tmp_path: Path) -> Callable[[str], Run]:
    """Run a program with the hook to its end, once for all tests."""

    def run_program(name: str) -> Run:
        if name not in _RUNS:
            child = start(PROGRAMS / name, recorded_into=tmp_path)
            status = child.end()
            _RUNS[name] = Run(status, child.text, recordings_in(tmp_path))
        return _RUNS[name]

    return run_program


def named(unit: Spec, function: str) -> Callback:
    (found,) = [c for c in written(unit) if (c.function or '').endswith(f'.{function}')]
    return found


@pytest.mark.parametrize(
    'program',
    [
        'moving_nodes.py',
        'own_classes.py',
        'everything_hidden.py',
        'forking.py',
        'churning.py',
        'again_and_again.py',
    ],
)
def test_program_behaves_the_same_with_the_hook(
    program: str, start: Start, run: RunProgram
) -> None:
    child = start(PROGRAMS / program)
    without = Run(child.end(), child.text)
    recorded = run(program)
    assert (recorded.status, recorded.text) == (without.status, without.text)
    assert {recording.losses for recording in recorded.recordings} == {0}


def test_nodes_are_told_by_the_executor_they_stayed_in(run: RunProgram) -> None:
    units = run('moving_nodes.py').units
    assert {name: (unit.executor.kind, unit.nodes) for name, unit in units.items()} == {
        'moving_nodes': ('MultiThreadedExecutor', ('arm', 'camera')),
        'base': ('SingleThreadedExecutor', ('base',)),
    }
    late = named(units['moving_nodes'], 'count')
    assert (late.when, late.conditional) == (When.CALLBACK, True)


def test_events_executor_is_seen(run: RunProgram) -> None:
    recorded = run('events_executor.py')
    if recorded.text == 'no EventsExecutor\n':
        pytest.skip('this rclpy has no EventsExecutor')
    (unit,) = recorded.units.values()
    assert recorded.text == 'ticks 3\n'
    assert (unit.executor.kind, len(unit.executor.threads)) == ('EventsExecutor', 1)
    assert {c.function_name for c in written(unit)} == {'tick', 'work'}
    measured = named(unit, 'tick').measured
    assert measured is not None
    assert (measured.count, measured.running, measured.threads) == (3, 0, 1)
    assert None not in (measured.period, measured.duration)


def test_own_classes_are_named_and_unresolved(run: RunProgram) -> None:
    (unit,) = run('own_classes.py').units.values()
    (timer,) = written(unit)
    own = unit.group_of(timer)
    source = 'tests/live/programs/own_classes.py'
    assert own.cls == 'CountingGroup'
    assert own.unresolved == Unknown('own group class CountingGroup', Place(source, 30, 9))
    assert unit.executor.unresolved == Unknown(
        'own executor class PatientExecutor', Place(source, 32, 12)
    )


def test_group_that_calls_its_base_is_counted_once(run: RunProgram) -> None:
    (unit,) = run('own_classes.py').units.values()
    (timer,) = written(unit)
    measured = timer.measured
    assert measured is not None
    assert (measured.count, measured.running, measured.threads) == (5, 0, 1)
    assert measured.period is not None
    assert measured.duration is not None


def test_specification_with_measurements_is_read_as_it_was_written(run: RunProgram) -> None:
    units = tuple(run('own_classes.py').units.values())
    assert read_specs(write_specs(units), 'live.yaml') == units


def test_hidden_entities_and_groupless_work_are_recorded(run: RunProgram) -> None:
    (unit,) = run('everything_hidden.py').units.values()
    assert {(c.entity, c.function_name or c.name, c.key, c.when) for c in written(unit)} == {
        (EntityKind.TIMER, 'blink', None, When.CONFIGURE),
        (EntityKind.TIMER, 'rate_timer', None, When.START),
        (EntityKind.SERVICE, 'on_press', 'press', When.START),
        (EntityKind.CLIENT, 'press_client', 'press', When.START),
        (EntityKind.SUBSCRIPTION, 'on_log', 'log', When.START),
        (EntityKind.DONE_CALLBACK, 'on_answer', None, When.START),
        (EntityKind.TASK, 'work_later', None, When.START),
        (EntityKind.TASK, 'think', None, When.START),
    }
    assert (named(unit, 'think').coroutine, named(unit, 'work_later').coroutine) == (True, False)
    assert named(unit, 'on_press').coroutine
    assert unit.group_of(named(unit, 'work_later')).groupless


def test_rclpys_own_entities_are_marked(run: RunProgram) -> None:
    (unit,) = run('everything_hidden.py').units.values()
    kinds = [c.entity for c in unit.callbacks if c.builtin and c.node == 'lamp']
    assert kinds.count(EntityKind.PARAMETER_SERVICE) == 6
    assert kinds.count(EntityKind.LIFECYCLE_SERVICE) == 5
    assert kinds.count(EntityKind.SERVICE) == 1


def test_each_process_has_a_file_of_its_own(run: RunProgram) -> None:
    recorded = run('forking.py')
    assert set(recorded.units) == {'parent', 'forked', 'spawned'}
    assert len({recording.pid for recording in recorded.recordings}) == 3


def test_entities_made_again_and_again_are_one_entry_with_a_count(run: RunProgram) -> None:
    unit = run('churning.py').units['churning']
    idle = [c for c in written(unit) if c.function_name == 'idle' and c.node == 'churning']
    assert sum(c.count for c in idle if isinstance(c.count, int)) == 40


def test_recording_is_no_longer_for_what_is_done_again_and_again(run: RunProgram) -> None:
    recorded = run('again_and_again.py')
    (recording,) = recorded.recordings
    stays = {node.name: len(node.stays) for node in recording.nodes}
    assert (len(recording.nodes), stays) == (2, {'spun': 1, 'helper': 1})
    assert (named(recorded.units['helper'], 'count').count, len(recording.executors)) == (1, 2)


def test_import_of_one_module_is_enough(start: Start, tmp_path: Path) -> None:
    program = tmp_path / 'importing.py'
    source = (PROGRAMS / 'own_classes.py').read_text()
    program.write_text(f'import ros2cc_extract.live\n{source}')
    child = start(program, PYTHONPATH=str(ROOT), ROS2CC_LIVE_DIR=str(tmp_path))
    assert (child.end(), child.text) == (0, 'begun 5\n')
    (recording,) = recordings_in(tmp_path)
    assert [spec.nodes for spec in specs_of(recording)] == [('careful',)]


def test_sitecustomize_of_the_user_still_runs(start: Start, tmp_path: Path) -> None:
    own = tmp_path / 'own'
    own.mkdir()
    (own / 'sitecustomize.py').write_text('print("the user\'s own", __name__)\n')
    child = start(PROGRAMS / 'own_classes.py', recorded_into=tmp_path, PYTHONPATH=str(own))
    assert child.end() == 0
    assert child.lines == ["the user's own sitecustomize\n", 'begun 5\n']
    assert len(recordings_in(tmp_path)) == 1


LIBRARY = """\
from std_msgs.msg import String


def listen(node):
    node.create_publisher(String, 'out', 1)
    return node.create_subscription(String, 'in', lambda message: None, 1)
"""
USER_OF_LIBRARY = """\
import rclpy
from message_filters import listen

rclpy.init()
node = rclpy.create_node('listener')
listen(node)
rclpy.spin_once(node, timeout_sec=0.5)
rclpy.shutdown()
"""


def test_qos_events_of_what_a_library_made_are_of_rclpy(start: Start, tmp_path: Path) -> None:
    """The wheels bring no such library; this one has the name of one."""
    (tmp_path / 'message_filters.py').write_text(LIBRARY)
    program = tmp_path / 'user.py'
    program.write_text(USER_OF_LIBRARY)
    assert start(program, recorded_into=tmp_path).end() == 0
    (unit,) = (spec for each in recordings_in(tmp_path) for spec in specs_of(each))
    assert [(c.entity, c.library) for c in written(unit)] == [
        (EntityKind.SUBSCRIPTION, 'message_filters')
    ]
    events = [c for c in unit.callbacks if c.entity is EntityKind.QOS_EVENT]
    assert len(events) > 4
    assert all(event.builtin for event in events)
