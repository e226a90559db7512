"""
Systems of two and three processes, started for real as their launch files say.

Those in which a circle of waits is found hang, and their mended twins go on. What each process is
set comes from the system specification, so that its names, remaps and parameters hold too.
"""

from __future__ import annotations

import io
import os
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest
from child import Child
from conftest import ROOT

from ros2cc_extract.pipeline.system_sources import scan_launch_files
from ros2cc_extract.spec.system.launched import Launched
from ros2cc_extract.spec.system.model import Process, System
from ros2cc_extract.spec.system.parameters import parameters_for
from tests.support.domains import free_domain

LAUNCH = ROOT / 'tests' / 'systems' / 'launch'
ASKS_BACK, GOES_ON = 'asks back\n', 'goes on\n'
ROUNDS = 3
BAD = {
    'calls_back_bad.launch.py': ASKS_BACK,
    'lock_over_call_bad.launch.py': ASKS_BACK,
    'relays_bad.launch.xml': ASKS_BACK,
    'called_alike_bad.launch.xml': ASKS_BACK,
    'goal_waits_bad.launch.py': ASKS_BACK,
    'goal_asks_bad.launch.xml': ASKS_BACK,
    '../large/ring_of_three_bad.launch.xml': ASKS_BACK,
    'asks_itself_bad.launch.xml': 'asks\n',
    'start_order_bad.launch.xml': 'not there\n',
    'start_answers_bad.launch.xml': 'not there\n',
}
"""What the last process says once it stands still."""
GOOD = {
    'calls_back_good.launch.py': ROUNDS,
    'lock_over_call_good.launch.py': ROUNDS,
    'relays_good.launch.yaml': ROUNDS,
    'called_alike_good.launch.xml': ROUNDS,
    'goal_waits_good.launch.py': ROUNDS,
    'goal_asks_good.launch.xml': ROUNDS,
    '../large/ring_of_three_good.launch.xml': ROUNDS,
    'asks_itself_good.launch.xml': ROUNDS,
    'start_order_good.launch.xml': 1,
    'start_answers_good.launch.xml': 1,
}
"""How often the first process goes on, at least."""
HANGS_FOR_S = 1.0
Running = dict[str, dict[str, Child]]


def arguments(launched: Launched, process: Process) -> Iterator[str]:
    """What ``ros2 launch`` puts on the command line of a process."""
    yield '--ros-args'
    if isinstance(launched.name, str):
        yield from ('-r', f'__node:={launched.name}')
    if isinstance(launched.namespace, str):
        yield from ('-r', f'__ns:={launched.namespace}')
    values, _ = parameters_for(launched, process.nodes)
    for name, value in values.items():
        yield from ('-p', f'{name}:={str(value).lower()}')
    for remap in launched.remaps:
        yield from ('-r', str(remap))


def system_of(name: str) -> System:
    return scan_launch_files([LAUNCH / name], {}, io.StringIO(), cached=False).system


@pytest.fixture(scope='module')
def bad_ones(rclpy_python: str) -> Iterator[Running]:
    with side_by_side(rclpy_python, BAD) as running:
        yield running


@pytest.fixture(scope='module')
def good_ones(rclpy_python: str) -> Iterator[Running]:
    with side_by_side(rclpy_python, GOOD) as running:
        yield running


@contextmanager
def side_by_side(rclpy_python: str, names: Iterable[str]) -> Iterator[Running]:
    """Systems at once, each in a domain of its own: its processes by name."""
    with ExitStack() as stack:
        started: Running = {}
        for name in names:
            env = {
                **os.environ,
                'ROS_DOMAIN_ID': str(stack.enter_context(free_domain())),
                'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
            }
            children: dict[str, Child] = {}
            for process in system_of(name).processes:
                assert process.file is not None
                command = [rclpy_python, str(Path(process.file).absolute())]
                child = Child([*command, *arguments(process.launched, process)], env)
                stack.callback(child.close)
                children[process.name] = child
            started[name] = children
        yield started


@pytest.mark.parametrize('name', GOOD)
def test_a_mended_system_goes_on(name: str, good_ones: Running) -> None:
    first, *_ = good_ones[name].values()
    first.read_until(lambda lines: lines.count(GOES_ON) >= GOOD[name])


@pytest.mark.parametrize('name', BAD)
def test_a_system_with_a_circle_hangs(name: str, bad_ones: Running) -> None:
    first, *_, last = [next(iter(bad_ones[name].values())), *bad_ones[name].values()]
    last.read_until(lambda lines: BAD[name] in lines)
    first.sleep(HANGS_FOR_S)
    first.process.kill()
    first.end()
    assert 'asks\n' in first.lines
    assert GOES_ON not in first.lines
