"""A Dask scheduler with workers, each a process of its own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ros2cc_extract.jobs.process_pool import ends_with_us

PATIENCE_S = 60.0


@dataclass(frozen=True)
class Cluster:
    """Where the scheduler listens, and the processes of the workers."""

    address: str
    workers: tuple[subprocess.Popen[bytes], ...]

    def kill(self, number: int) -> None:
        """End a worker without a word."""
        self.workers[number].send_signal(signal.SIGKILL)


@contextmanager
def dask_cluster(folder: Path, workers: int) -> Iterator[Cluster]:
    """Start a scheduler and its workers; ``folder`` is for what they write."""
    where = folder / 'scheduler.json'
    begun = [_started(folder, 'scheduler', '--port', '0', '--host', '127.0.0.1', where)]
    try:
        _wait_for(where)
        names = ('--nthreads', '1', '--no-nanny', '--local-directory', folder)
        begun += [_started(folder, 'worker', *names, where) for _ in range(workers)]
        address = json.loads(where.read_text())['address']
        _wait_for_workers(address, workers)
        yield Cluster(address, tuple(begun[1:]))
    finally:
        for process in reversed(begun):
            process.kill()
            process.wait()


def _started(folder: Path, kind: str, *arguments: object) -> subprocess.Popen[bytes]:
    *options, where = arguments
    command = [sys.executable, '-m', f'distributed.cli.dask_{kind}', *map(str, options)]
    command += ['--scheduler-file', str(where), '--no-dashboard']
    with (folder / f'{kind}.log').open('ab') as log:
        return subprocess.Popen(
            command,
            cwd=folder,
            stdout=log,
            stderr=log,
            env=_environment(),
            preexec_fn=ends_with_us(),
        )


def _environment() -> dict[str, str]:
    return {**os.environ, 'DASK_DISTRIBUTED__WORKER__USE_FILE_LOCKING': 'False'}


def _wait_for(path: Path) -> None:
    give_up = time.monotonic() + PATIENCE_S
    while not (path.exists() and path.read_text().strip().endswith('}')):
        assert time.monotonic() < give_up, f'{path} was not written'
        time.sleep(0.05)


def _wait_for_workers(address: str, number: int) -> None:
    """Ask in a process of its own: a client leaves threads behind, and tests fork."""
    if not number:
        return
    program = (
        'import sys; from distributed import Client; '
        f'Client(sys.argv[1], timeout={PATIENCE_S}).wait_for_workers({number})'
    )
    subprocess.run([sys.executable, '-c', program, address], check=True, timeout=PATIENCE_S)
