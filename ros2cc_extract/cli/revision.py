"""The findings of another git revision, so that a check can show only what a change adds."""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import tarfile
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cli.pipeline import Job, check_paths
from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.findings.fingerprints import fingerprints


def fingerprints_at(revision: str, job: Job, stderr: TextIO) -> frozenset[str]:
    """
    Check the same paths as they are in ``revision``, and give the fingerprints of what is found.

    :raises InputError: when this is no git repository, or there is no such revision.
    """
    if revision.startswith('-'):
        raise InputError(f'{revision!r} is no revision', None, 'name a revision git knows')
    top = Path(_git(Path.cwd(), 'rev-parse', '--show-toplevel').decode().strip())
    here = Path.cwd().resolve().relative_to(top)
    with tempfile.TemporaryDirectory(prefix='ros2cc-base-') as name:
        _unpack(_git(top, 'archive', '--format=tar', revision), Path(name))
        with _inside(Path(name) / here):
            paths = [path for path in map(_as_relative, job.paths) if path.exists()]
            if not paths:
                return frozenset()
            root = Path(name).resolve()
            outcome = check_paths(replace(job, paths=paths, root=root, known=frozenset()), stderr)
            return frozenset(fingerprints(outcome.findings, root.as_posix()))


def _as_relative(path: Path) -> Path:
    """An absolute path would lead back to the files of now."""
    return path.resolve().relative_to(Path.cwd().resolve()) if path.is_absolute() else path


def _git(folder: Path, *arguments: str) -> bytes:
    try:
        done = subprocess.run(
            ['git', *arguments],
            cwd=folder,
            capture_output=True,
            stdin=subprocess.DEVNULL,
            check=False,
        )
    except OSError as error:
        raise ToolNotFoundError(f'git cannot be started: {error.strerror}') from None
    if done.returncode:
        said = done.stderr.decode('utf-8', 'replace').strip().splitlines() or ['no reason given']
        raise InputError(f'git {arguments[0]}: {said[-1]}', None, 'name a revision git knows')
    return done.stdout


def _unpack(archive: bytes, folder: Path) -> None:
    with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
        tar.extractall(folder, filter='data')


@contextlib.contextmanager
def _inside(folder: Path) -> Iterator[None]:
    """Places are shown relative to the current folder: so must those of the other revision."""
    before = Path.cwd()
    folder.mkdir(parents=True, exist_ok=True)
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
