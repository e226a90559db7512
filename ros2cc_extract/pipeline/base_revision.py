"""The findings of another git revision, so that a check can show only what a change adds."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TextIO

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.static.program.project import python_files
from ros2cc_extract.findings.base.fingerprints import fingerprints
from ros2cc_extract.pipeline.check import Job, check_paths
from ros2cc_extract.revision.git import KNOWN, Repository
from ros2cc_extract.revision.snapshot import Snapshot
from ros2cc_extract.version import PROGRAM

FETCH = 'fetch it: git fetch --depth=1 origin BRANCH, or actions/checkout with fetch-depth: 0'


def fingerprints_at(revision: str, job: Job, stderr: TextIO) -> frozenset[str]:
    """
    Check the same paths as they were where the change left ``revision``; give the fingerprints.

    It takes half of the time at most. What is not found by then counts as new.

    :raises InputError: when this is no git repository, there is no such revision, or a path is
        not in the repository.
    """
    if revision.startswith('-'):
        raise InputError(f'{revision!r} is no revision', None, KNOWN)
    repository = Repository(Path.cwd(), is_named=True)
    shown = repository.ask('rev-parse', '--show-toplevel')
    top = Path(os.fsdecode(shown.removesuffix(b'\n'))).resolve()
    base = _fork_point(repository, revision)

    def report(line: str) -> None:
        print(f'{PROGRAM}: {line}', file=stderr)

    files = Snapshot.of(repository, top, base, report)
    paths = [path for path in job.paths if _has_python(files, path)]
    if not paths:
        return frozenset()
    files.read_ahead(paths)
    half_s = None if job.max_seconds is None else job.max_seconds / 2
    outcome = check_paths(
        replace(job, paths=paths, known=frozenset(), files=files, noticed=(), max_seconds=half_s),
        stderr,
    )
    if outcome.interrupted:
        raise KeyboardInterrupt
    return frozenset(fingerprints(outcome.findings, job.root.as_posix()))


def _has_python(files: Snapshot, path: Path) -> bool:
    if files.place_of(path) is None:
        return False
    inside = python_files(files, path, lambda error: None)
    return files.is_file(path) or next(inside, None) is not None


def _fork_point(repository: Repository, revision: str) -> str:
    """
    The commit from which ``revision`` and this one come: what came later there is not here.

    Without common history, as in a shallow clone, that is ``revision`` itself.
    """
    known = repository.try_to_ask('rev-parse', '--quiet', '--verify', f'{revision}^{{commit}}')
    if known.status:
        is_shallow = repository.ask('rev-parse', '--is-shallow-repository').strip() == b'true'
        what = f'this {"shallow clone" if is_shallow else "repository"} has no revision'
        raise InputError(f'{what} {revision!r}', None, FETCH if is_shallow else KNOWN)
    commit = known.out.decode().strip()
    common = repository.try_to_ask('merge-base', commit, 'HEAD')
    return commit if common.status else common.out.decode().strip()
