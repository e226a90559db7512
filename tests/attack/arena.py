"""Runs hostile inputs one by one, watched: what hangs is ended, what crashes is begun anew."""

from __future__ import annotations

import json
import os
import select
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ros2cc_extract.jobs.process_pool import ends_with_us
from tests.support.repositories import environment

PATIENCE_S = 120
"""Of the clock, on a machine that others use too."""
MOST_SECONDS, MOST_MEGABYTES = 10.0, 1_000.0
"""Of CPU and memory, for any input; see docs/limits.md."""
STATUSES = (0, 1, 2, 3)
CANARY = 'canary'


@dataclass(frozen=True)
class Attempt:
    """
    One hostile input.

    :param prepare: fills the folder that the command is called in.
    :param writes: names of what the command may leave there.
    """

    arguments: tuple[str, ...]
    prepare: Callable[[Path], None]
    writes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Found:
    """What gave way: its kind, see ``conftest``, and what was seen."""

    kind: str
    told: str


@dataclass
class Arena:
    """
    A folder with everything that an attempt can touch, and the process that is attacked.

    :param base: of nobody else.
    """

    base: Path
    _process: subprocess.Popen[bytes] | None = field(default=None, repr=False)

    @property
    def canary(self) -> Path:
        """What code that must not run writes."""
        return self.base / CANARY

    @property
    def temporary(self) -> Path:
        return self.base / 'temporary'

    def judge(self, attempt: Attempt) -> Found | None:
        folder = self.base / 'input'
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        attempt.prepare(folder)
        before = listing(folder)
        found = self._ask(attempt.arguments, folder) or self._seen_outside()
        kept = {name for name in listing(folder) - before if not name.startswith(attempt.writes)}
        if found is None and kept:
            found = Found('leftover', f'files {sorted(kept)}')
        return found

    def _seen_outside(self) -> Found | None:
        if self.canary.exists():
            self.canary.unlink()
            return Found('canary', 'code of the input was run')
        left = self._tidied()
        return Found('leftover', f'temporary {left}') if left else None

    def _tidied(self) -> list[str]:
        """What was among the temporary files."""
        left = sorted(self.temporary.iterdir())
        for path in left:
            shutil.rmtree(path, ignore_errors=True)
            if path.exists():
                path.unlink()
        return [path.name for path in left]

    def _ask(self, arguments: tuple[str, ...], folder: Path) -> Found | None:
        process = self._started()
        assert process.stdin is not None and process.stdout is not None
        question = json.dumps({'arguments': arguments, 'folder': str(folder)})
        process.stdin.write(question.encode() + b'\n')
        process.stdin.flush()
        if not select.select([process.stdout], [], [], PATIENCE_S)[0]:
            process.send_signal(signal.SIGABRT)  # it says where it stands
            return Found('hang', self._ended())
        line = process.stdout.readline()
        return judged(json.loads(line)) if line else Found('crash', self._ended())

    def _started(self) -> subprocess.Popen[bytes]:
        if self._process is None:
            self.temporary.mkdir(exist_ok=True)
            ours = {
                'XDG_CACHE_HOME': str(self.base / 'cache'),
                'TMPDIR': str(self.temporary),
                'ROS2CC_TRACEBACK': '1',
            }
            with (self.base / 'complaints').open('wb') as complaints:
                self._process = subprocess.Popen(
                    [sys.executable, '-m', 'tests.attack.worker'],
                    cwd=Path(__file__).parents[2],
                    env=environment(**ours),
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=complaints,
                    start_new_session=True,
                    preexec_fn=ends_with_us(),
                )
        return self._process

    def _ended(self) -> str:
        """End the process with all that it has begun: its last words."""
        process, self._process = self._process, None
        assert process is not None
        try:
            process.wait(5)
        except subprocess.TimeoutExpired:
            process.kill()
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        status = process.wait()
        for stream in (process.stdin, process.stdout):
            assert stream is not None
            stream.close()
        self._tidied()
        said = (self.base / 'complaints').read_bytes()[-3_000:].decode(errors='replace')
        return f'status {status}: {said}'

    def close(self) -> None:
        if self._process is not None:
            assert self._process.stdin is not None
            self._process.stdin.close()
            self._ended_quietly()

    def _ended_quietly(self) -> None:
        assert self._process is not None
        try:
            self._process.wait(5)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


@contextmanager
def arena(base: Path) -> Iterator[Arena]:
    made = Arena(base)
    try:
        yield made
    finally:
        made.close()


def judged(told: dict[str, Any]) -> Found | None:
    """Judge how a command ended by what it says and cost."""
    words = f'{told["out"]}{told["err"]}'
    if told['crash']:
        return Found('crash', told['crash'])
    if 'internal error' in told['err'] or 'Traceback' in told['err']:
        return Found('internal error', told['err'][-500:])
    if ' cannot be followed: ' in words:  # a defect while one file was followed
        return Found('internal error', words[-500:])
    if told['status'] not in STATUSES:
        return Found('crash', f'status {told["status"]}: {told["err"][-500:]}')
    if told['left']:
        return Found('leftover', f'in the process: {told["left"]}')
    if told['seconds'] > MOST_SECONDS or told['megabytes'] > MOST_MEGABYTES:
        return Found('too dear', f'{told["seconds"]:.1f} s, {told["megabytes"]:.0f} MB')
    return None


def listing(folder: Path) -> set[str]:
    return {
        str(path.relative_to(folder)) for path in folder.rglob('*') if '.git/' not in str(path)
    }
