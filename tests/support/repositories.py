"""Git repositories for tests, with nobody's settings but their own."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

BIN = Path(sys.executable).parent


def environment(**more: str) -> dict[str, str]:
    """The environment of a developer who works with the tools that run the tests."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(('GIT_', 'PYTEST', 'COLUMNS'))
    }
    ours = {
        'PATH': f'{BIN}{os.pathsep}{os.environ["PATH"]}',
        'GIT_CONFIG_GLOBAL': os.devnull,
        'GIT_CONFIG_SYSTEM': os.devnull,
        'GIT_AUTHOR_NAME': 'Somebody',
        'GIT_AUTHOR_EMAIL': 'somebody@example.org',
        'GIT_COMMITTER_NAME': 'Somebody',
        'GIT_COMMITTER_EMAIL': 'somebody@example.org',
    }
    return {**kept, **ours, **more}


def git(folder: Path, *arguments: str, **more: str) -> subprocess.CompletedProcess[str]:
    """Run git in ``folder``; whether it worked is for the caller to see."""
    return subprocess.run(
        ['git', *arguments],
        cwd=folder,
        env=environment(**more),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )


def make_repository(folder: Path) -> None:
    """Make an empty repository with the branch ``main``."""
    folder.mkdir(exist_ok=True)
    done = git(folder, 'init', '--quiet', '--initial-branch', 'main')
    assert done.returncode == 0, done.stdout


def commit(folder: Path, message: str, **more: str) -> subprocess.CompletedProcess[str]:
    """Commit everything in ``folder``, hooks included."""
    added = git(folder, 'add', '--all')
    assert added.returncode == 0, added.stdout
    return git(folder, 'commit', '--quiet', '--message', message, **more)
