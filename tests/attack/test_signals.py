"""A signal at any moment: the process ends as it should, nothing goes on and nothing is left."""

from __future__ import annotations

import os
import random
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.attack.conftest import Tally
from tests.attack.environments import SUBCOMMANDS, fill
from tests.support.repositories import environment
from tests.support.starting import PATIENCE_S, TOOL

CLASS = 'signals'
EXAMPLES = Path(__file__).parents[2] / 'launch_free_examples'
SIGNALS = (
    *(signal.SIGTERM, signal.SIGHUP, signal.SIGINT, signal.SIGKILL, signal.SIGQUIT),
    *(signal.SIGPIPE, signal.SIGUSR1, signal.SIGALRM, signal.SIGXCPU, signal.SIGSEGV),
)
ORDERLY = (signal.SIGTERM, signal.SIGHUP, signal.SIGINT)
"""After these nothing may be left; the others give no time to tidy up."""
LATEST_S = 1.5
MOMENTS, MOMENTS_OF_RECORD = 4, 250
WORK = {
    **{name: words for name, words in SUBCOMMANDS.items() if name not in ('help', 'run')},
    'check a repository': ('check', '.', '--no-cache'),
    'run': ('run', '-o', 'out.yaml', '--', 'sleep', '2'),
}


@pytest.mark.parametrize(
    ('first', 'moments'),
    [(0, MOMENTS), pytest.param(MOMENTS, MOMENTS_OF_RECORD, marks=pytest.mark.slow)],
)
def test_a_signal_at_any_moment(first: int, moments: int, tmp_path: Path, tally: Tally) -> None:
    told = []
    for number in range(first, first + moments):
        chance = random.Random(number)
        tally.add()
        found = attacked(chance, tmp_path / str(number))
        if found:
            kind, seen = found
            tally.found[kind] += 1
            told.append(f'{number}: {kind}: {seen}')
        shutil.rmtree(tmp_path / str(number))
    assert not told, '\n\n'.join(told)


def attacked(chance: random.Random, base: Path) -> tuple[str, str] | None:
    folder, temporary = base / 'package', base / 'temporary'
    fill(folder)
    temporary.mkdir()
    for example in EXAMPLES.glob('*/node.py'):
        shutil.copy(example, folder / f'{example.parent.name}.py')
    before = {path.name for path in folder.rglob('*')}
    name, number, delay = chance.choice(list(WORK)), chance.choice(SIGNALS), chance.random()
    whom = chance.choice((os.kill, os.killpg))
    process = subprocess.Popen(
        [*TOOL, *WORK[name]],
        cwd=folder,
        env=environment(XDG_CACHE_HOME=str(base / 'cache'), TMPDIR=str(temporary)),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )
    what = f'{name}, {number.name} after {delay:.2f}, {whom.__name__}'
    if number is signal.SIGINT:
        wait_for_the_tool(process)  # before, Python itself prints where it was
    time.sleep(delay * LATEST_S)
    if process.poll() is None:
        whom(process.pid, number)
    try:
        _, err = process.communicate(timeout=PATIENCE_S)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return 'hang', what
    if left := survivors(process.pid):
        os.killpg(process.pid, signal.SIGKILL)
        return 'leftover', f'{what}: processes {left}'
    if process.returncode not in (0, 1, 2, 3, 128 + number, -number):
        return 'crash', f'{what}: status {process.returncode}: {err.decode()[-500:]}'
    if b'Traceback' in err or b'internal error' in err or b'Exception ignored' in err:
        return 'internal error', f'{what}: {err.decode()[-1_500:]}'
    files = {path.name for path in folder.rglob('*')} - before
    odd = [
        each for each in files if '.tmp' in each or (each.startswith('.') and each[1:4] == 'out')
    ]
    odd += [path.name for path in temporary.iterdir()]
    if number in ORDERLY and odd:
        return 'leftover', f'{what}: files {odd}'
    return None


def wait_for_the_tool(process: subprocess.Popen[bytes]) -> None:
    """Until it hears requests to end."""
    status = Path(f'/proc/{process.pid}/status')
    while process.poll() is None:
        lines = dict(line.split(':', 1) for line in status.read_text().splitlines())
        if int(lines.get('SigCgt', '0'), 16) >> (signal.SIGTERM - 1) & 1:
            return
        time.sleep(0.01)


def survivors(group: int) -> list[str]:
    """Processes of the group that are still there a little later."""
    ends_at = time.monotonic() + 10
    while found := members(group):
        if time.monotonic() > ends_at:
            return found
        time.sleep(0.05)
    return []


def members(group: int) -> list[str]:
    found = []
    for path in Path('/proc').glob('[0-9]*/stat'):
        try:
            rest = path.read_text().rpartition(')')[2].split()
        except OSError:
            continue
        if rest[0] != 'Z' and int(rest[2]) == group:
            found.append(path.parent.name)
    return found
