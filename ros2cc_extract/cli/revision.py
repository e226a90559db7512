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

KNOWN = 'name a revision git knows'
FETCH = 'fetch it: git fetch --depth=1 origin BRANCH, or actions/checkout with fetch-depth: 0'


def fingerprints_at(revision: str, job: Job, stderr: TextIO) -> frozenset[str]:
    """
    Check the same paths as they were where the change left ``revision``; give the fingerprints.

    :raises InputError: when this is no git repository, or there is no such revision.
    """
    if revision.startswith('-'):
        raise InputError(f'{revision!r} is no revision', None, KNOWN)
    top = Path(_git(Path.cwd(), 'rev-parse', '--show-toplevel').decode().strip())
    here = Path.cwd().resolve().relative_to(top)
    base = _fork_point(top, revision)
    with tempfile.TemporaryDirectory(prefix='ros2cc-base-') as name:
        _unpack(top, base, Path(name))
        with _inside(Path(name) / here):
            paths = [path for path in map(_as_relative, job.paths) if path.exists()]
            if not paths:
                return frozenset()
            root = Path(name).resolve()
            outcome = check_paths(replace(job, paths=paths, root=root, known=frozenset()), stderr)
            if outcome.interrupted:
                raise KeyboardInterrupt
            return frozenset(fingerprints(outcome.findings, root.as_posix()))


def _fork_point(top: Path, revision: str) -> str:
    """
    The commit from which ``revision`` and this one come: what came later there is not here.

    Without common history, as in a shallow clone, that is ``revision`` itself.
    """
    known = _run_git(top, 'rev-parse', '--quiet', '--verify', f'{revision}^{{commit}}')
    if known.returncode:
        is_shallow = _git(top, 'rev-parse', '--is-shallow-repository').strip() == b'true'
        what = f'this {"shallow clone" if is_shallow else "repository"} has no revision'
        raise InputError(f'{what} {revision!r}', None, FETCH if is_shallow else KNOWN)
    common = _run_git(top, 'merge-base', revision, 'HEAD')
    return (known if common.returncode else common).stdout.decode().strip()


def _as_relative(path: Path) -> Path:
    """An absolute path would lead back to the files of now."""
    return path.resolve().relative_to(Path.cwd().resolve()) if path.is_absolute() else path


def _git(folder: Path, *arguments: str) -> bytes:
    done = _run_git(folder, *arguments)
    if done.returncode:
        said = done.stderr.decode('utf-8', 'replace').strip().splitlines() or ['no reason given']
        reason = next((line for line in said if line.startswith('fatal: ')), said[-1])
        advice = said[-1].strip() if 'safe.directory' in said[-1] else KNOWN
        raise InputError(f'git {arguments[0]}: {reason}', None, advice)
    return bytes(done.stdout)


def _run_git(folder: Path, *arguments: str) -> subprocess.CompletedProcess[bytes]:
    try:
        return subprocess.run(
            ['git', *arguments],
            cwd=folder,
            capture_output=True,
            stdin=subprocess.DEVNULL,
            check=False,
        )
    except OSError as error:
        raise ToolNotFoundError(f'git cannot be started: {error.strerror}') from None


def _unpack(top: Path, revision: str, folder: Path) -> None:
    """Write the files of a revision; those of submodules as far as they are checked out."""
    archive = _git(top, 'archive', '--format=tar', revision)
    with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
        tar.extractall(folder, filter='data')
    for commit, path in _submodules(top, revision):
        has_commit = (top / path / '.git').exists() and not _run_git(
            top / path, 'cat-file', '-e', f'{commit}^{{commit}}'
        ).returncode
        if has_commit:
            _unpack(top / path, commit, folder / path)


def _submodules(top: Path, revision: str) -> Iterator[tuple[str, str]]:
    """Commit and path of each, as the revision has them."""
    for entry in _git(top, 'ls-tree', '-r', '-z', '--full-tree', revision).split(b'\0'):
        mode, _, rest = entry.partition(b' ')
        if mode == b'160000':
            named, _, path = rest.partition(b'\t')
            yield named.split()[-1].decode(), os.fsdecode(path)


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
