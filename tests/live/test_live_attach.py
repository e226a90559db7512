"""A process that was started without the hook tells what it holds, and goes on."""

from __future__ import annotations

import importlib.util
import io
import signal
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from child import Child
from expectations import EXPECTED
from held import of_spec, without_unknown_keys

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.attach import attach_process
from ros2cc_extract.places import Unknown
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.yaml_io import load_specs

CAN_ATTACH = hasattr(sys, 'remote_exec') or importlib.util.find_spec('hypno') is not None
needs_injector = pytest.mark.skipif(
    not CAN_ATTACH, reason='needs Python 3.14 or the extra attach (hypno)'
)


def attach(child: Child, folder: Path) -> Spec:
    output = folder / 'attached.yaml'
    assert attach_process(child.process.pid, output, io.StringIO()) == 0
    (spec,) = load_specs(output)
    return spec


@needs_injector
@pytest.mark.parametrize(
    ('name', 'says'),
    [('action_server', 'goals done'), ('lambda_in_loop', 'alpha')],
)
def test_running_process_tells_what_it_holds_and_goes_on(
    name: str, says: str, start_example: Callable[..., Child], tmp_path: Path
) -> None:
    child = start_example(name)
    child.read_until(lambda lines: any(says in line for line in lines))
    spec = attach(child, tmp_path)
    expected = without_unknown_keys(EXPECTED[name], of_spec(spec))
    assert of_spec(spec) == expected
    before = len(child.lines)
    child.read_until(lambda lines: any(says in line for line in lines[before:]))
    assert child.end(signal.SIGINT) == 0, child.text


@needs_injector
def test_action_server_without_a_name_is_unknown_and_has_its_execute_callback(
    start_example: Callable[..., Child], tmp_path: Path
) -> None:
    child = start_example('action_server')
    child.read_until(lambda lines: any('goals done' in line for line in lines))
    spec = attach(child, tmp_path)
    server, execute = (c for c in spec.callbacks if (c.key is not None and not c.builtin))
    assert server.key == Unknown('rclpy does not keep the name of an action server')
    assert (execute.display_name, execute.groupless) == ('execute', True)


def test_process_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='there is no process 4194305'):
        attach_process(4194305, tmp_path / 'attached.yaml', io.StringIO())
