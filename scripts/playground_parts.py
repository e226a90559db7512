#!/usr/bin/env python3
"""
What the playground of the site is made of beside its page: Pyodide, this package, and a node.

Pyodide comes from npm once and is kept in ``.cache``. The package and what it imports come from
this checkout and this environment: the playground is of the version that the pages speak of.
"""

from __future__ import annotations

import base64
import hashlib
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / 'launch_free_examples' / 'service_deadlock' / 'node.py'
# One version with its digest, since it runs in the browsers of readers: CPython 3.14, tried with
# all examples. Of its package what the page loads, and what names its licence.
VERSION = '314.0.7'
DIGEST = '0YvXxEhfEdpLfb/XkM2BFAeMROq0iMUX2bzzH9pOttyMcWkwq+HbE5uyuGD82LN7y2q+SNvi/6V5JEsOlD2R1A=='
PYODIDE = (
    'package.json',
    'pyodide-lock.json',
    'pyodide.asm.mjs',
    'pyodide.asm.wasm',
    'pyodide.mjs',
    'python_stdlib.zip',
)
# What a check imports, each with plain Python for all that it does natively. rich draws no colours
# and no Markdown here, so what it does that with is left out.
CARRIED = ('PyYAML', 'Jinja2', 'MarkupSafe', 'lark', 'rich')
NPM_S = 180


class LeftOutError(Exception):
    """The parts cannot be had here, and why."""


def make_parts(folder: Path) -> None:
    """
    Put all parts into ``folder``, anew.

    :raises LeftOutError: where something is missing that has to come from the net.
    """
    kept = pyodide()
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(kept, folder / 'pyodide')
    write_tool(folder / 'tool.zip')
    shutil.copy(EXAMPLE, folder / 'node.py')


def pyodide() -> Path:
    """
    Give the folder with what the page needs of Pyodide.

    :raises LeftOutError: where npm does not give it.
    """
    kept = ROOT / '.cache' / f'pyodide-{VERSION}'
    if kept.is_dir():
        return kept
    kept.parent.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(dir=kept.parent) as name:
        archive, folder = _packed(Path(name)), Path(name) / 'kept'
        folder.mkdir()
        with tarfile.open(archive) as members:
            for part in PYODIDE:
                member = members.extractfile(f'package/{part}')
                assert member is not None, part
                (folder / part).write_bytes(member.read())
        return folder.rename(kept)


def _packed(folder: Path) -> Path:
    """Have npm give the package, and make sure that it is what was tried."""
    npm = shutil.which('npm')
    if npm is None:
        raise LeftOutError('npm is not here')
    command = [npm, 'pack', '--silent', '--fetch-retries=1', f'pyodide@{VERSION}']
    try:
        # No pipes: what npm may have started would keep them open when its time is over.
        done = subprocess.run(
            command,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            check=False,
            timeout=NPM_S,
        )
    except subprocess.TimeoutExpired:
        raise LeftOutError(f'npm took more than {NPM_S} s') from None
    found = list(folder.glob('*.tgz'))
    if done.returncode or not found:
        raise LeftOutError(f'npm does not give pyodide {VERSION}')
    digest = base64.b64encode(hashlib.sha512(found[0].read_bytes()).digest()).decode()
    if digest != DIGEST:
        raise ValueError(f'npm gives another pyodide {VERSION} than was tried: {digest}')
    return found[0]


def write_tool(archive: Path) -> None:
    """Write an archive of the package as it is installed without native parts, and its imports."""
    with tempfile.TemporaryDirectory() as name, zipfile.ZipFile(archive, 'w') as written:
        build = ['-q', 'build', '--build-base', f'{name}/base', '--build-lib', f'{name}/lib']
        environment = {**os.environ, 'ROS2CC_NATIVE_BUILD': 'none'}
        command = [sys.executable, 'setup.py', *build]
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f'the package cannot be built: {done.stderr}')
        built = Path(name) / 'lib'
        own = ((path, str(path.relative_to(built))) for path in built.rglob('*'))
        for path, to in sorted([*own, *_carried()]):
            if path.is_file():
                written.write(path, to, zipfile.ZIP_DEFLATED)


def _carried() -> Iterator[tuple[Path, str]]:
    """Give the files of other packages: plain Python with its data, and the licences."""
    for name in CARRIED:
        for file in metadata.distribution(name).files or ():
            is_told = 'licen' in str(file).lower() or file.name == 'METADATA'
            is_code = not file.parts[0].endswith('.dist-info') and file.parts[0] != '..'
            if is_told or (is_code and file.suffix not in ('.so', '.pyc')):
                yield Path(str(file.locate())), str(file)
