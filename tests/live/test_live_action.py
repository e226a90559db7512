"""An action of a real type, on each release: as without the hook, and as the scanner reads it."""

from __future__ import annotations

import io
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest
from interpreters import EVERY_RELEASE, interpreter_of
from recorded import PROGRAMS, written

from ros2cc_extract.cli.main import main
from ros2cc_extract.spec.model import EntityKind
from ros2cc_extract.spec.yaml.yaml_io import load_specs

PROGRAM = PROGRAMS / 'real_action.py'
# The goal that was reached, and the one that was cancelled.
ENDED = '[(4, [0, 1, 2, 3, 4]), (5, [])]\n'


@pytest.fixture(scope='module', params=EVERY_RELEASE)
def python(request: pytest.FixtureRequest) -> str:
    found = interpreter_of(request.param)
    probe = subprocess.run([found, '-c', 'import test_msgs.action'], check=False)
    if probe.returncode:
        pytest.skip('test_msgs is not installed')
    return found


def test_action_is_the_same_with_the_hook_and_without(
    python: str, ros_env: Mapping[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in ros_env.items():
        monkeypatch.setenv(name, value)
    told = tmp_path / 'told'
    shell = ['sh', '-c', f'exec {python} {PROGRAM} > {told}']
    subprocess.run(shell, check=True, timeout=300)
    assert told.read_text() == ENDED
    said, output = io.StringIO(), tmp_path / 'live.yaml'
    options = ['-o', str(output), '--trace', str(tmp_path / 'run.jsonl'), '--check', str(PROGRAM)]
    assert main(['run', *options, '--', *shell], said, said) == 0, said.getvalue()
    assert told.read_text() == ENDED
    assert 'no difference' in said.getvalue()
    (unit,) = load_specs(output)
    assert {
        (callback.entity, callback.key, callback.display_name)
        for callback in written(unit)
        if callback.entity is not EntityKind.DONE_CALLBACK
    } == {
        (EntityKind.ACTION_SERVER, 'count', "action server 'count'"),
        (EntityKind.ACTION_CLIENT, 'count', "action client 'count'"),
        (EntityKind.ACTION_EXECUTE, 'count', 'Server.execute'),
    }
