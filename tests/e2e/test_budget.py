"""Time for all units of one call; and what is told when somebody ends it before."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.e2e.conftest import EXAMPLES, Run, environment
from tests.support.knots import write_knots

REASON = 'the limit of 3 s for all units was reached; see --max-seconds'


def repository(folder: Path) -> Path:
    """One node that is decided at once, and some that are not within seconds."""
    write_knots(folder, 6)
    node = EXAMPLES / 'service_deadlock' / 'node.py'
    (folder / 'short.py').write_text(node.read_text(encoding='utf-8'), encoding='utf-8')
    return folder


def test_what_the_time_leaves_open_is_undecided_and_the_rest_is_told(
    run: Run, tmp_path: Path
) -> None:
    repository(tmp_path / 'src')
    told = run('src', '--max-seconds', 3, '--output-format', 'json')
    assert told.status == 1
    report = json.loads(told.out)
    verdicts = {unit['model']: unit['queries'] for unit in report['verdicts']}
    assert 'CC101' in {finding['code'] for finding in report['findings']}
    reasons = {q['reason'] for q in verdicts['knot'] if q['verdict'] == 'undecided'}
    assert REASON in reasons
    assert report['summary']['undecided'] > 0
    assert report['summary']['units'] == 7


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
    assert ' 7 units, ' in out.splitlines()[-1]
    assert 'undecided' in out.splitlines()[-1]
    assert err == 'interrupted: what was not verified by then is undecided\n'
