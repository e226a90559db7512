"""What every live test needs: an interpreter with rclpy, a DDS domain of its own, examples."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import asdict
from pathlib import Path
from types import MappingProxyType

import pytest
from child import Child
from interpreters import EVERY_RELEASE, INTERPRETER_VARIABLE, interpreter_of
from side_by_side import Built, Program, RunForked

from ros2cc_extract.extract.live.environment import hooked_environment
from tests.releases.turns import release_of_the_day
from tests.support.domains import free_domain

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / 'launch_free_examples'
PROBE = Path(__file__).with_name('probe.py')
FORKED = Path(__file__).with_name('forked.py')
AT_ONCE = 8


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.live)


@pytest.fixture(scope='session')
def rclpy_python() -> str:
    """Give an interpreter that imports rclpy; skip where there is none."""
    return interpreter_of(INTERPRETER_VARIABLE)


@pytest.fixture
def domain() -> Iterator[int]:
    """Hold a domain for the test."""
    with free_domain() as number:
        yield number


@pytest.fixture(scope='session')
def run_forked(rclpy_python: str) -> RunForked:
    """Run programs side by side."""
    return runner_by(rclpy_python)


@pytest.fixture(scope='module', params=EVERY_RELEASE)
def run_forked_everywhere(request: pytest.FixtureRequest) -> RunForked:
    """Run programs side by side on each release that is there."""
    return runner_by(interpreter_of(request.param))


@pytest.fixture(scope='module')
def built_today() -> Built:
    """Run programs side by side on the release whose turn it is to be built."""
    python, release = release_of_the_day()
    return release.version, runner_by(python, release.over({}))


def runner_by(python: str, more: Mapping[str, str] = MappingProxyType({})) -> RunForked:
    """Give what runs programs ``AT_ONCE`` at a time, each for as long as it has to."""

    def run(programs: Iterable[Program]) -> dict[str, list[str]]:
        with ExitStack() as stack:
            domains = [stack.enter_context(free_domain()) for _ in range(AT_ONCE)]
            found = subprocess.run(
                [python, FORKED, ','.join(map(str, domains))],
                input=json.dumps([asdict(program) for program in programs]),
                env={**os.environ, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST', **more},
                stdout=subprocess.PIPE,
                text=True,
                check=True,
            )
        told: dict[str, list[str]] = json.loads(found.stdout)
        return told

    return run


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
        traced: bool = False,
        **variables: str,
    ) -> Child:
        env = {**ros_env, **variables}
        if recorded_into:
            env = hooked_environment(env, recorded_into, traced=traced)
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
