"""``scripts/rclpy-tests`` on checkouts of a few tests, that need no rclpy."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / 'scripts/rclpy-tests'
HEAD = "import os, pathlib, sys\nHOOKED = 'ROS2CC_LIVE_DIR' in os.environ\n"
ALIKE = 'def test_passes(): pass\ndef test_fails(): assert False\n'
NOTICES_ONCE = """
def test_notices_once():
    once = pathlib.Path(os.environ['ONCE'])
    noticed = HOOKED and not once.exists()
    HOOKED and once.touch()
    assert not noticed
"""
NOTICES = """
def test_notices(): assert not HOOKED
def test_crashes(): os.environ.get('ROS2CC_LIVE_TRACE') == '1' and os.abort()
def test_goes_on(): pass
"""
# The hook misses what it wraps there.
BREAKS_HOOK = """
def test_breaks_the_hook():
    sys.path.insert(0, str(pathlib.Path(__file__).parent / 'broken'))
    import rclpy.executors
"""
Answer = tuple[int, list[str]]


def run(folder: Path, text: str) -> Answer:
    """Compare the ways to run one file of tests: exit status and the lines of the answer."""
    broken = folder / 'test/broken/rclpy'
    broken.mkdir(parents=True)
    (broken / '__init__.py').touch()
    (broken / 'executors.py').touch()
    (folder / 'test/test_some.py').write_text(HEAD + text)
    ran = subprocess.run(
        [sys.executable, SCRIPT, folder],
        env={**os.environ, 'PYTEST_DISABLE_PLUGIN_AUTOLOAD': '1', 'ONCE': str(folder / 'once')},
        stdout=subprocess.PIPE,
        text=True,
    )
    return ran.returncode, [line.strip() for line in ran.stdout.splitlines()]


def six_times(outcome: str) -> str:
    return ', '.join([outcome] * 6)


@pytest.fixture(scope='module')
def alike(tmp_path_factory: pytest.TempPathFactory) -> Answer:
    return run(tmp_path_factory.mktemp('alike'), ALIKE + NOTICES_ONCE)


@pytest.fixture(scope='module')
def noticing(tmp_path_factory: pytest.TempPathFactory) -> Answer:
    return run(tmp_path_factory.mktemp('noticing'), NOTICES + BREAKS_HOOK)


def test_table_counts_the_outcomes_of_each_way(alike: Answer) -> None:
    counts = [line.split()[-7:] for line in alike[1][-4:]]
    plain, noticed = [*'21', *'00000'], [*'12', *'00000']
    assert counts == [plain, noticed, plain, plain]


def test_difference_that_does_not_come_again_does_not_count(alike: Answer) -> None:
    status, lines = alike
    assert status == 0
    assert (
        'came and went: test/test_some.py::test_notices_once (specification): '
        'failed, passed; without the hook passed, passed' in lines
    )


def test_difference_that_persists_is_told_for_each_way(noticing: Answer) -> None:
    status, lines = noticing
    assert status == 1
    differs = 'DIFFERS: test/test_some.py::test_notices'
    ended = f'{six_times("failed")}; without the hook {six_times("passed")}'
    ways = ('specification', 'trace', 'trace, hook in Python')
    assert [line for line in lines if differs in line] == [
        f'{differs} ({way}): {ended}' for way in ways
    ]


def test_crash_is_told_and_the_other_tests_are_run(noticing: Answer) -> None:
    _, lines = noticing
    assert (
        f'DIFFERS: test/test_some.py::test_crashes (trace): {six_times("not ended")}; '
        f'without the hook {six_times("passed")}' in lines
    )
    assert not any('test_goes_on' in line for line in lines)


def test_failure_of_the_hook_itself_is_told(noticing: Answer) -> None:
    lost = [line for line in noticing[1] if line.startswith('LOST: test_some.py (specification)')]
    assert len(lost) == 6
    assert all('KeyError' in line for line in lost)
