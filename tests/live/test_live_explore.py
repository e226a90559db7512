"""``explore`` on real rclpy: finds what is rare, repeats it, and finds nothing in good twins."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from ros2cc_extract.confirm.processes import DOMAINS_VARIABLE
from tests.support.domains import free_domains

ROOT = Path(__file__).parents[2]
BUGS = ROOT / 'tests/bugs'
NODES = ROOT / 'tests/explore/nodes'
AT_ONCE = 3
MARKED = Path(__file__).parent / 'programs' / 'marked.py'


@pytest.fixture(autouse=True)
def own_domains(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Nobody else's messages, and none for anybody else."""
    with free_domains(AT_ONCE) as numbers:
        monkeypatch.setenv(DOMAINS_VARIABLE, f'{numbers[0]}-{numbers[-1]}')
        yield


def explore(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, '-m', 'ros2cc_extract.cli.main', 'explore', '--yes']
    done = subprocess.run([*command, *map(str, arguments)], capture_output=True, text=True)
    assert 'Traceback' not in done.stderr, done.stderr
    return done


@pytest.mark.slow
def test_what_is_rare_is_found_and_nothing_in_a_good_twin(
    rclpy_python: str, tmp_path: Path
) -> None:
    """Three programs that mostly wait for their turns, side by side."""
    folders = [tmp_path / name for name in ('deadlock', 'exception', 'twin')]
    with ThreadPoolExecutor(AT_ONCE) as pool:
        tried = [
            pool.submit(a_rare_deadlock_is_found_and_repeated, rclpy_python, folders[0]),
            pool.submit(an_exception_between_test_and_use_is_found, rclpy_python, folders[1]),
            pool.submit(nothing_is_found_in, 'g4_lock_order_mended', rclpy_python, folders[2]),
        ]
        for each in tried:
            each.result()


def a_rare_deadlock_is_found_and_repeated(rclpy_python: str, tmp_path: Path) -> None:
    node = NODES / 'rare_lock_order.py'
    found = explore(
        *('--first', '--schedules', 60, '-o', tmp_path, '--output-format', 'json'),
        *('--', rclpy_python, node),
    )
    assert found.returncode == 1, found.stdout + found.stderr
    (failure,) = json.loads(found.stdout)['failures']
    assert (failure['kind'], failure['path']) == ('hang', str(node))
    assert 'waits forever for a lock' in failure['evidence']
    assert failure['policy'] in ('pct', 'random'), 'it is rare without a schedule'
    again = explore('--replay', failure['file'])
    assert again.returncode == 1
    assert re.match(rf'.*rare_lock_order\.py:{failure["line"]}: hang repeated in', again.stdout)


def an_exception_between_test_and_use_is_found(rclpy_python: str, tmp_path: Path) -> None:
    node = NODES / 'goal_gone.py'
    found = explore('--first', '--schedules', 60, '-o', tmp_path, '--', rclpy_python, node)
    assert found.returncode == 1, found.stdout + found.stderr
    words = "AttributeError: 'NoneType' object has no attribute 'data'"
    assert f'goal_gone.py:29: exception: {words}' in found.stdout
    assert re.search(r'Driver.cancel .*: goal_gone.py:\d+ write Driver.goal', found.stdout)


# How often the program repeats itself depends on the machine: too rarely for each change.
@pytest.mark.slow
def test_all_orders_of_two_callbacks_are_run(rclpy_python: str, tmp_path: Path) -> None:
    """Read and write of each, and the begins are independent: two in a row, and two lost."""
    options = ('--strategy', 'depth-first', '-o', tmp_path, '--output-format', 'json')
    done = explore(*options, '--', rclpy_python, NODES / 'lost_credit.py')
    found = json.loads(done.stdout)
    assert found['statement'].startswith('complete: all 4 orders of the first run of each'), found
    assert {(each['kind'], each['line']) for each in found['failures']} == {
        ('lost update', 22),
        ('lost update', 27),
    }


@pytest.mark.slow
def test_nothing_is_found_in_another_good_twin(rclpy_python: str, tmp_path: Path) -> None:
    nothing_is_found_in('g2_lost_update_mended', rclpy_python, tmp_path / 'twin')


def nothing_is_found_in(name: str, rclpy_python: str, tmp_path: Path) -> None:
    done = explore('--schedules', 22, '-o', tmp_path, '--', rclpy_python, BUGS / f'{name}.py')
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.startswith('no failure in 22 schedules and a plain run')
    assert not tmp_path.exists() or not list(tmp_path.iterdir())


def test_a_command_without_a_node_is_said_so(rclpy_python: str, tmp_path: Path) -> None:
    done = explore('-o', tmp_path, '--', rclpy_python, '-c', 'raise SystemExit("no robot here")')
    assert (done.returncode, done.stdout) == (2, '')
    assert 'no process of the command has loaded rclpy.executors: no robot here' in done.stderr


def run_marked(python: str, domain: int, cache: Path, *arguments: str) -> str:
    """Run the marked tests with pytest, in the interpreter that has rclpy."""
    paths = [str(ROOT), str(Path(pytest.__file__).parents[1])]
    env = {
        **os.environ,
        'PYTHONPATH': os.pathsep.join(paths),
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'PYTEST_DISABLE_PLUGIN_AUTOLOAD': '1',
    }
    plugin = ['-p', 'ros2cc_extract.ros.pytest_schedules', '-o', f'cache_dir={cache}']
    command = [python, '-m', 'pytest', '-q', *plugin, '-c', os.devnull, '--noconftest']
    command += [str(MARKED), *arguments]
    done = subprocess.run(command, env=env, capture_output=True, text=True, cwd=MARKED.parent)
    return done.stdout + done.stderr


def test_a_marked_test_fails_under_a_schedule_that_its_number_repeats(
    rclpy_python: str, domain: int, tmp_path: Path
) -> None:
    said = run_marked(rclpy_python, domain, tmp_path, '-k', 'not locks')
    assert '1 failed, 3 passed' in said, said
    assert 'lost update: count was 0 when line' in said
    number = re.search(r'--ros2cc-schedule=(\d+)', said)
    assert number is not None, said
    again = run_marked(rclpy_python, domain, tmp_path, '-k', 'both_count', number.group(0))
    assert '1 failed' in again and f'schedule {number.group(1)}; repeat it' in again


@pytest.mark.slow
def test_the_order_is_repeated_where_the_number_gives_another(
    rclpy_python: str, domain: int, tmp_path: Path
) -> None:
    """As on a machine that is slower at this moment: what is ready in time differs."""
    said = run_marked(rclpy_python, domain, tmp_path, '-k', 'both_count')
    number = re.search(r'--ros2cc-schedule=(\d+)', said)
    assert number is not None and int(number.group(1)) > 1, said
    (kept,) = (tmp_path / 'v/ros2cc/failed_orders').iterdir()
    row = json.loads(kept.read_text())
    first = {**row, 'schedule': 1}
    kept.write_text(json.dumps(first))
    asked = ('-k', 'both_count', '--ros2cc-schedule=1')
    again = run_marked(rclpy_python, domain, tmp_path, *asked)
    assert '1 failed' in again and 'schedule 1; repeat it' in again, again
    kept.write_text(json.dumps({**first, 'points': 'of sources before they were mended'}))
    assert '1 passed' in run_marked(rclpy_python, domain, tmp_path, *asked)


def test_a_marked_test_that_hangs_is_ended_and_says_why(
    rclpy_python: str, domain: int, tmp_path: Path
) -> None:
    said = run_marked(rclpy_python, domain, tmp_path, '-k', 'locks or without')
    assert '1 failed, 1 passed' in said, said
    assert re.search(r'marked\.py:\d+: hang: Counter\.on_\w+ waits forever for a lock', said)
    assert 'the lock is held by Counter.on_' in said
