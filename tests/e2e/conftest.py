"""Runs the installed command as a user would: a process of its own, in a folder of its own."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.support.starting import run_command

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / 'launch_free_examples'


@dataclass(frozen=True)
class Outcome:
    """What a run of the command left."""

    status: int
    out: str
    err: str


def environment(cache: Path) -> dict[str, str]:
    """As the user's, but for a table width of its own and a cache that nobody shares."""
    inherited = {name: value for name, value in os.environ.items() if name != 'COLUMNS'}
    return {**inherited, 'XDG_CACHE_HOME': str(cache)}


Run = Callable[..., Outcome]


@pytest.fixture
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The user's cache folder of one test, outside its work tree."""
    return tmp_path_factory.mktemp('cache')


@pytest.fixture
def run(tmp_path: Path, cache: Path) -> Run:
    return runner(tmp_path, cache)


def runner(folder: Path, cache: Path) -> Run:
    """What runs the command in ``folder``, where no other is named."""

    def run_there(
        *arguments: object, cwd: Path = folder, prefix: Sequence[str] = (), given: bytes = b''
    ) -> Outcome:
        done = run_command(arguments, cwd=cwd, env=environment(cache), prefix=prefix, given=given)
        return Outcome(done.returncode, done.stdout.decode(), done.stderr.decode())

    return run_there
