"""Time for all units of one call; and what is reported when it is ended before."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.e2e.conftest import EXAMPLES, Run, environment
from tests.support.knots import write_knots
from tests.support.mazes import write_mazes
from tests.support.products import every_pair

LIMIT_S = 3
REASON = f'the limit of {LIMIT_S} s for all units was reached; see --max-seconds'


def repository(folder: Path, others: int = 12) -> Path:
    """One node that is decided at once, and some that are not within seconds."""
    write_knots(folder, others)
    node = EXAMPLES / 'service_deadlock' / 'node.py'
    (folder / 'short.py').write_text(node.read_text(encoding='utf-8'), encoding='utf-8')
    return folder


def test_what_the_time_leaves_open_is_undecided_and_the_rest_is_told(
    run: Run, tmp_path: Path
) -> None:
    repository(tmp_path / 'src', others=40)  # some 1.5 s each, on any machine of today
    told = run('src', '--max-seconds', LIMIT_S, '--output-format', 'json')
    assert told.status == 1
    report = json.loads(told.out)
    verdicts = {unit['model']: unit['queries'] for unit in report['verdicts']}
    assert 'CC101' in {finding['code'] for finding in report['findings']}
    reasons = {q['reason'] for q in verdicts['knot'] if q['verdict'] == 'undecided'}
    assert REASON in reasons
    assert report['summary']['undecided'] > 0
    assert report['summary']['units'] == 41


@pytest.mark.parametrize(('number', 'status'), [(signal.SIGTERM, 143), (signal.SIGINT, 130)])
def test_whoever_is_asked_to_end_tells_what_is_done(
    number: int, status: int, tmp_path: Path, cache: Path
) -> None:
    repository(tmp_path / 'src')
    child = subprocess.Popen(
        [sys.executable, '-m', 'ros2cc_extract.cli.main', 'src'],
        cwd=tmp_path,
        env=environment(cache),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    give_up = time.monotonic() + 60
    while not list(cache.rglob('*.verdicts')):
        assert child.poll() is None
        assert time.monotonic() < give_up
        time.sleep(0.05)
    child.send_signal(number)
    out, err = child.communicate(timeout=60)
    assert child.returncode == status
    assert 'short.py:' in out
    assert 'CC101' in out
    assert ' in 13 files; ' in out.splitlines()[-1]
    assert 'undecided' in out.splitlines()[-1]
    assert err == 'interrupted: what was not verified yet is undecided\n'


def long_to_scan(folder: Path, *, remarks: int = 0) -> Path:
    """One node that is scanned at once, and some that take long, in several processes if large."""
    write_mazes(folder, 40, remarks=remarks)
    node = EXAMPLES / 'service_deadlock' / 'node.py'
    (folder / 'a_short.py').write_text(node.read_text(encoding='utf-8'), encoding='utf-8')
    return folder


@pytest.mark.parametrize('remarks', [0, 1_000])
def test_scanning_is_within_the_time_too(run: Run, tmp_path: Path, remarks: int) -> None:
    long_to_scan(tmp_path / 'src', remarks=remarks)
    told = run('src', '--max-seconds', LIMIT_S, '--profile', 'rclpy')
    assert told.status == 1
    assert (
        f'files are not followed to their end: the limit of {LIMIT_S} s for all units' in told.out
    )
    assert 'a_short.py:' in told.out
    assert 'CC101' in told.out


@pytest.mark.parametrize(
    ('ending', 'remarks'),
    every_pair([(signal.SIGTERM, 143), (signal.SIGINT, 130)], [0, 1_000]),
)
def test_whoever_is_asked_to_end_while_scanning_tells_what_is_done(
    ending: tuple[int, int], remarks: int, tmp_path: Path, cache: Path
) -> None:
    number, status = ending
    long_to_scan(tmp_path / 'src', remarks=remarks)
    child = subprocess.Popen(
        [sys.executable, '-m', 'ros2cc_extract.cli.main', 'src'],
        cwd=tmp_path,
        env=environment(cache),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    give_up = time.monotonic() + 120
    while cpu_seconds(child.pid) < 4.0:
        assert child.poll() is None
        assert time.monotonic() < give_up
        time.sleep(0.05)
    child.send_signal(number)
    out, err = child.communicate(timeout=60)
    assert child.returncode == status
    assert 'files are not followed to their end: interrupted' in out
    assert 'a_short.py:' in out
    assert ' in 41 files' in out.splitlines()[-1]
    assert err == 'interrupted: what was not verified yet is undecided\n'


def cpu_seconds(pid: int) -> float:
    """What a process and its living children have taken so far."""
    every = [pid]
    for task in Path(f'/proc/{pid}/task').glob('*/children'):
        every += map(int, task.read_text().split())
    ticks = 0
    for one in every:
        fields = Path(f'/proc/{one}/stat').read_text().rpartition(')')[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / os.sysconf('SC_CLK_TCK')
