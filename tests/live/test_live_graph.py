"""What runs, by the ROS graph and by recordings, against what a launch file says."""

from __future__ import annotations

import io
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
import yaml
from child import Child
from conftest import ROOT
from test_live_systems import arguments, system_of

from ros2cc_extract.cli.main import main
from ros2cc_extract.extract.live.environment import hooked_environment

LAUNCH = ROOT / 'tests' / 'systems' / 'launch'
GOOD = 'names_good.launch.py'


def told(*words: str) -> tuple[int, str, str]:
    out, err = io.StringIO(), io.StringIO()
    return main(list(words), out, err), out.getvalue(), err.getvalue()


def said(*words: str) -> tuple[int, str, str]:
    """What another process tells."""
    command = [sys.executable, '-m', 'ros2cc_extract.cli.main', *words]
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


@pytest.fixture
def recordings(tmp_path: Path) -> Path:
    folder = tmp_path / 'live'
    folder.mkdir()
    return folder


@pytest.fixture
def running(
    rclpy_python: str,
    ros_env: dict[str, str],
    recordings: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[str]:
    """The processes of a launch file, all hooked; gives the interpreter that sees them."""
    env = hooked_environment(ros_env, recordings)
    children = []
    try:
        for process in system_of(GOOD).processes:
            assert process.file is not None
            command = [rclpy_python, str(ROOT / process.file)]
            children.append(Child([*command, *arguments(process.launched, process)], env))
        for name in ('ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE'):
            monkeypatch.setenv(name, ros_env[name])
        children[0].wait_for(lambda: len(list(recordings.glob('*.json'))) == len(children))
        yield rclpy_python
    finally:
        for child in children:
            child.close()


def test_the_graph_and_the_recordings_are_what_the_launch_file_says(
    running: str, recordings: Path, tmp_path: Path
) -> None:
    """Each look waits until nothing new is seen: three at a time."""
    path = str(LAUNCH / GOOD)
    look = ('--running', '--python', running, '--seconds', '20')
    other = tmp_path / 'other.launch.xml'
    other.write_text(
        '<launch>'
        f'<executable cmd="python3 {ROOT}/tests/systems/programs/asker.py --ros-args -r plan:=p"/>'
        '</launch>'
    )
    with ThreadPoolExecutor() as pool:
        as_launched = pool.submit(said, 'diff', path, *look)
        as_system = pool.submit(said, 'system', *look)
        as_other = pool.submit(said, 'diff', str(other), *look, '--output-format', 'json')
        status, out, _ = told('diff', path, str(recordings))
    assert status == 0, out
    status, out, err = as_launched.result()
    assert (status, err) == (0, ''), out
    assert 'no difference between' in ' '.join(out.split())
    _, out, _ = as_system.result()
    nodes = [p['nodes'][0]['name'] for p in yaml.safe_load(out)['system']['processes']]
    assert sorted(nodes) == ['/asker', '/robot/asker', '/robot/sink']
    status, out, _ = as_other.result()
    assert status == 1
    found: list[dict[str, Any]] = yaml.safe_load(out)
    rows = [(each['unit'], each['fact'], each['left'], each['right']) for each in found]
    assert rows == [
        ('/asker', 'name', '/p', '/robot/plan'),
        ('/robot/asker', 'node', '', 'process /robot/asker'),
        ('/robot/sink', 'node', '', 'process /robot/sink'),
    ]


def test_nobody_in_sight_is_said(
    rclpy_python: str, domain: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('ROS_DOMAIN_ID', str(domain))
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    status, _, err = told('system', '--running', '--python', rclpy_python, '--seconds', '1')
    assert status == 2
    assert f'no node is found in ROS domain {domain} within 1 s' in err


def test_an_interpreter_without_rclpy_is_said() -> None:
    status, _, err = told('system', '--running', '--python', '/usr/bin/false')
    assert status == 2
    assert '/usr/bin/false cannot look at the graph; source your ROS 2 environment' in err
