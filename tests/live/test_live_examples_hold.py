"""The examples hold in real rclpy what their sources and expected specifications say."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Callable

import pytest
from child import Child
from conftest import EXAMPLES, PROBE
from expectations import EXPECTED
from held import of_probe, of_spec, without_unknown_keys

from ros2cc_extract.spec import yaml_io

Observe = Callable[[str], list[str]]


@pytest.fixture
def observe(start: Callable[..., Child]) -> Observe:
    """Run an example until its first executor has told what it holds; give the lines told."""

    def run(name: str) -> list[str]:
        reader, writer = os.pipe()
        program = EXAMPLES / name / 'node.py'
        child = start(PROBE, str(writer), str(program), pass_fds=(writer,))
        os.close(writer)
        with os.fdopen(reader) as told:
            first = told.readline()
            assert first, child.end()
            assert child.end(signal.SIGINT) == 0, child.text
            return [first, *told]

    return run


def test_every_example_has_an_expectation() -> None:
    assert set(EXPECTED) == {path.parent.name for path in EXAMPLES.glob('*/node.py')}


@pytest.mark.parametrize('name', sorted(EXPECTED))
def test_executor_holds_what_the_source_says(name: str, observe: Observe) -> None:
    (told,) = observe(name)
    assert of_probe(json.loads(told)) == EXPECTED[name]


def test_expected_specifications_say_what_the_executors_hold() -> None:
    files = sorted(EXAMPLES.glob('*/expected.spec.yaml'))
    if not files:
        pytest.skip('no example has an expected.spec.yaml yet')
    for file in files:
        (spec,) = yaml_io.read_specs(file)
        observed = EXPECTED[file.parent.name]
        assert without_unknown_keys(observed, of_spec(spec)) == of_spec(spec), file
