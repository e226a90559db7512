"""
The examples hold in real rclpy what their sources say, and so says everything that we extract.

Each example runs once, under the probe and with the hook; the probe is the judge of both.
"""

from __future__ import annotations

import io
import json
import os
import signal
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from child import Child
from conftest import EXAMPLES, PROBE
from expectations import EXPECTED
from held import Held, of_probe, of_spec, without_unknown_keys

from ros2cc_extract.compare.merge import diff
from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.extract.live.recordings.recording import Recording
from ros2cc_extract.extract.live.run import read_directory
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.yaml.yaml_io import load_specs

every_example = pytest.mark.parametrize('name', sorted(EXPECTED))


@dataclass(frozen=True)
class Observation:
    """What the probe reported of the executors of one process, and what the hook recorded."""

    told: tuple[Held, ...]
    recording: Recording

    @property
    def specs(self) -> tuple[Spec, ...]:
        return specs_of(self.recording)


BUILTINS_OF_EVERY_OPTION = 46

Observe = Callable[[str], Observation]
_OBSERVED: dict[str, Observation] = {}


@pytest.fixture
def observe(start: Callable[..., Child], tmp_path: Path) -> Observe:
    """Run an example until its first executor waits for work, once for all tests."""

    def run(name: str) -> Observation:
        if name not in _OBSERVED:
            _OBSERVED[name] = run_under_probe(start, EXAMPLES / name / 'node.py', tmp_path)
        return _OBSERVED[name]

    return run


def run_under_probe(start: Callable[..., Child], program: Path, folder: Path) -> Observation:
    reader, writer = os.pipe()
    child = start(PROBE, str(writer), str(program), pass_fds=(writer,), recorded_into=folder)
    os.close(writer)
    with os.fdopen(reader) as told:
        first = told.readline()
        assert first, child.end()
        wanted = len(json.loads(first)['entities'])
        child.wait_for(lambda: written_entities(folder) >= wanted)
        child.end_well(signal.SIGINT)
        lines = [first, *told]
    (recording,) = read_directory(folder, io.StringIO())
    return Observation(tuple(of_probe(json.loads(line)) for line in lines), recording)


def written_entities(folder: Path) -> int:
    """Count what the recordings in a folder hold so far, without rclpy's own."""
    recordings = read_directory(folder, io.StringIO())
    specs = (spec for recording in recordings for spec in specs_of(recording))
    callbacks = (callback for spec in specs for callback in spec.callbacks)
    return sum(not callback.builtin and not callback.groupless for callback in callbacks)


def test_every_example_has_an_expectation() -> None:
    assert set(EXPECTED) == {path.parent.name for path in EXAMPLES.glob('*/node.py')}


@every_example
def test_executor_holds_what_the_source_says(name: str, observe: Observe) -> None:
    (told,) = observe(name).told
    assert told == without_unknown_keys(EXPECTED[name], told)


@every_example
def test_hook_records_what_the_executor_holds(name: str, observe: Observe) -> None:
    observation = observe(name)
    (spec,) = observation.specs
    assert of_spec(spec) == EXPECTED[name]
    assert (observation.recording.losses, spec.unresolved) == (0, ())


@every_example
def test_static_and_live_specification_are_equal(name: str, observe: Observe) -> None:
    static = scan([EXAMPLES / name / 'node.py']).units
    assert [each for each in diff(static, observe(name).specs) if not each.marked] == []


@every_example
def test_what_rclpy_makes_by_itself_is_listed_alike(name: str, observe: Observe) -> None:
    (spec,) = observe(name).specs
    (static,) = scan([EXAMPLES / name / 'node.py'], lists_builtin=True).units
    assert builtins_of(static) == builtins_of(spec)


def test_every_option_of_a_node_that_adds_entities(
    start: Callable[..., Child], tmp_path: Path
) -> None:
    program = Path(__file__).with_name('programs') / 'every_builtin.py'
    (spec,) = run_under_probe(start, program, tmp_path).specs
    (static,) = scan([program], lists_builtin=True).units
    assert builtins_of(static) == builtins_of(spec)
    assert len(builtins_of(spec)) == BUILTINS_OF_EVERY_OPTION
    # rclpy keeps no topic of an event handler; it is read where that is made.
    assert [
        (c.key, c.node) for c in spec.callbacks if c.function and 'on_other_qos' in c.function
    ] == [('stop', 'arm')]
    assert [each for each in diff([static], [spec]) if not each.marked] == []


def builtins_of(spec: Spec) -> list[tuple[object, ...]]:
    """What nobody wrote, by everything that does not depend on a run, and who shares its group."""
    members: dict[str, list[str]] = {}
    for callback in spec.callbacks:
        kind = callback.entity.value if callback.entity else ''
        mate = f'{callback.node}/{callback.name}' if callback.builtin else kind
        members.setdefault(callback.group, []).append(mate)
    groups = {group.name: (group.type.value, group.default) for group in spec.groups}
    return sorted(
        (
            c.name,
            str(c.node),
            str(c.entity),
            str(c.function),
            str(c.key),
            str(c.source),
            groups[c.group],
            tuple(sorted(members[c.group])),
        )
        for c in spec.callbacks
        if c.builtin
    )


def test_expected_specifications_say_what_the_executors_hold() -> None:
    files = sorted(EXAMPLES.glob('*/expected.spec.yaml'))
    if not files:
        pytest.skip('no example has an expected.spec.yaml yet')
    for file in files:
        (spec,) = load_specs(file)
        observed = EXPECTED[file.parent.name]
        assert without_unknown_keys(observed, of_spec(spec)) == of_spec(spec), file
