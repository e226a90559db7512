"""The source distribution, made of what git knows and of nothing else that lies about."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# What pip calls too, PEP 517.
HOOK = """
import sys
from setuptools import build_meta
getattr(build_meta, 'build_' + sys.argv[1])(sys.argv[2])
"""


def copied_tree(to: Path) -> Path:
    """Copy the files that are, or may be, committed; builds leave lists and objects behind."""
    shutil.rmtree(to, ignore_errors=True)
    asked = ['git', 'ls-files', '-z', '--cached', '--others', '--exclude-standard']
    listed = subprocess.run(asked, cwd=ROOT, check=True, capture_output=True).stdout
    for name in sorted(set(os.fsdecode(listed).split('\0')) - {''}):
        if (ROOT / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, to / name, follow_symlinks=False)
    return to


def build(kind: str, source: Path, to: Path, *, native: str) -> Path:
    """Build ``sdist`` or ``wheel`` with what this environment has; see ``setup.py`` for native."""
    before = set(to.glob('*'))
    command = [sys.executable, '-c', HOOK, kind, to.resolve()]
    environment = {**os.environ, 'ROS2CC_NATIVE_BUILD': native}
    done = subprocess.run(command, cwd=source, env=environment, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f'{done.stdout}{done.stderr}\nthe {kind} could not be built')
    (built,) = set(to.glob('*')) - before
    return built


def sdist(work: Path, to: Path) -> Path:
    """Make the source distribution, anew."""
    to.mkdir(parents=True, exist_ok=True)
    for old in to.glob('*.tar.gz'):
        old.unlink()
    return build('sdist', copied_tree(work / 'source'), to, native='optional')


def unpacked(archive: Path, to: Path) -> Path:
    shutil.rmtree(to, ignore_errors=True)
    shutil.unpack_archive(archive, to)
    (folder,) = to.iterdir()
    return folder
