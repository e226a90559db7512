"""What every live test needs: an interpreter with rclpy, a DDS domain of its own, examples."""

from __future__ import annotations

import fcntl
import itertools
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from child import Child

from ros2cc_extract.extract.live.environment import hooked_environment

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / 'launch_free_examples'
PROBE = Path(__file__).with_name('probe.py')
INTERPRETER_VARIABLE = 'ROS2CC_RCLPY_PYTHON'
# The ports of domains up to 101 stay below Linux' ephemeral ports.
DOMAINS = range(1, 102)
# A domain is not used again soon: what a killed node announced stays known for a while.
_DOMAINS_IN_TURN = itertools.cycle(random.sample(DOMAINS, len(DOMAINS)))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.live)
            # Real processes and real middleware: one lost race is theirs, three are ours.
            item.add_marker(pytest.mark.flaky(reruns=2))


@pytest.fixture(scope='session')
def rclpy_python() -> str:
    """Give an interpreter that imports rclpy; skip where there is none."""
    python = os.environ.get(INTERPRETER_VARIABLE, sys.executable)
    tried = subprocess.run([python, '-c', 'import rclpy'], capture_output=True, check=False)
    if tried.returncode:
        pytest.skip(f'no rclpy in {python}; set {INTERPRETER_VARIABLE} to one that has it')
    return python


@pytest.fixture
def domain() -> Iterator[int]:
    """Hold a DDS domain that no other test process on this machine uses."""
    for number in itertools.islice(_DOMAINS_IN_TURN, len(DOMAINS)):
        path = Path(tempfile.gettempdir()) / f'ros2cc-test-domain-{number}.lock'
        with path.open('w') as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            yield number
            return
    pytest.fail('all DDS domains are in use by other test processes')


@pytest.fixture
def ros_env(domain: int) -> dict[str, str]:
    """The environment of a test's children: a domain of their own, nothing beyond this machine."""
    return {
        **os.environ,
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
    }


@pytest.fixture
def start(rclpy_python: str, ros_env: dict[str, str]) -> Iterator[Callable[..., Child]]:
    """Start Python programs with rclpy; whatever is left of them is killed after the test."""
    children: list[Child] = []

    def start_program(
        program: Path,
        *arguments: str,
        pass_fds: tuple[int, ...] = (),
        recorded_into: Path | None = None,
        **variables: str,
    ) -> Child:
        env = {**ros_env, **variables}
        if recorded_into:
            env = hooked_environment(env, recorded_into)
        child = Child([rclpy_python, str(program), *arguments], env, pass_fds)
        children.append(child)
        return child

    yield start_program
    for child in children:
        child.close()


@pytest.fixture
def start_example(start: Callable[..., Child]) -> Callable[..., Child]:
    """Start an example by the name of its folder."""

    def start_by_name(name: str, *arguments: str) -> Child:
        return start(EXAMPLES / name / 'node.py', *arguments)

    return start_by_name
