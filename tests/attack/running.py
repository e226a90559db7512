"""Runs the command as anybody might: a process of its own, which must end by itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.support.repositories import environment
from tests.support.starting import run_command


@dataclass(frozen=True)
class Ended:
    """How a run has ended."""

    status: int
    out: str
    err: str

    @property
    def told(self) -> str:
        return self.out + self.err


def run_tool(*arguments: object, cwd: Path, prefix: Sequence[str] = (), **variables: str) -> Ended:
    env = environment(**{'XDG_CACHE_HOME': f'{cwd}.cache', **variables})
    done = run_command(arguments, cwd=cwd, env=env, prefix=prefix)
    texts = (stream.decode(errors='surrogateescape') for stream in (done.stdout, done.stderr))
    return Ended(done.returncode, *texts)


def assert_orderly(ended: Ended) -> None:
    """One of the documented statuses, and no word of a defect."""
    assert ended.status in (0, 1, 2, 3), ended.told
    for word in ('internal error', 'Traceback', 'Exception ignored'):
        assert word not in ended.told, ended.told
