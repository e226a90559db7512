"""
A CPython on musl, built of Debian's sources: no release of Debian has one.

It is for trials alone: without ``ssl`` and ``ctypes``, and barely optimised. ``musl-gcc`` of the
package ``musl-tools`` compiles it, some minutes of CPU for each version; a build that was cut
goes on where it was.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from release.debian import SUITES, fetched_sources

COMPILER = 'musl-gcc'
CONFIGURED = 'configured'
# CPython's configure asks gcc, and the setup.py of 3.11 too, with one hyphen; gcc would name the
# system that it runs on, whose headers are not those of musl.
WRAPPER = """#!/bin/sh
case " $* " in *"-print-multiarch "*) echo x86_64-linux-musl; exit 0;; esac
exec musl-gcc "$@"
"""
# musl brings no headers of the kernel; those of Linux serve every C library.
KERNEL = {
    'linux': '/usr/include/linux',
    'asm': '/usr/include/x86_64-linux-gnu/asm',
    'asm-generic': '/usr/include/asm-generic',
}


def musl_python(version: str, work: Path) -> Path | None:
    """Give a CPython of this machine that runs on musl; nothing where it cannot be built."""
    folder = work / f'musl-{version}'
    python, complete = folder / f'usr/bin/python{version}', folder / 'complete'
    is_possible = os.uname().machine == 'x86_64' and shutil.which(COMPILER)
    if not is_possible or version not in SUITES:
        return None
    _begun(folder)
    if complete.exists():
        return python
    trees = _sources(version, folder)
    if not trees:
        return None
    zlib, cpython = trees
    environment = {**os.environ, 'CFLAGS': f'-O1 -fPIC -isystem {folder / "kernel"}'}
    environment |= dict.fromkeys(('CC', 'CXX'), str(folder / 'compiler'))
    with (folder / 'output').open('a', encoding='utf-8') as output:
        for tree, command in _steps(zlib, cpython, folder):
            if command[0] == './configure' and (tree / CONFIGURED).exists():
                continue
            done = subprocess.run(
                command, cwd=tree, env=environment, stdout=output, stderr=subprocess.STDOUT
            )
            if done.returncode:
                print(f'CPython {version} on musl: see {folder / "output"}', file=sys.stderr)
                return None
            if command[0] == './configure':
                (tree / CONFIGURED).touch()
    complete.touch()
    return python


def _begun(folder: Path) -> None:
    """Make the folder, or keep what a build like this has left there: ``make`` goes on with it."""
    settings = repr((str(folder), WRAPPER, _steps(Path(), Path(), folder)))
    asked = folder / 'asked'
    if asked.exists() and asked.read_text(encoding='utf-8') == settings:
        return
    shutil.rmtree(folder, ignore_errors=True)
    (folder / 'kernel').mkdir(parents=True)
    for name, headers in KERNEL.items():
        (folder / 'kernel' / name).symlink_to(headers)
    compiler = folder / 'compiler'
    compiler.write_text(WRAPPER, encoding='utf-8')
    compiler.chmod(0o755)
    asked.write_text(settings, encoding='utf-8')


def _sources(version: str, folder: Path) -> tuple[Path, Path] | None:
    """Give the trees of zlib and CPython; nothing where their sources cannot be had."""
    unpacked = folder / 'unpacked'
    if not unpacked.exists():
        wanted = [f'python{version}', 'zlib']
        archives = fetched_sources(SUITES[version], wanted, folder / 'sources')
        if len(archives) != len(wanted):
            return None
        unfinished = folder / 'unfinished'
        shutil.rmtree(unfinished, ignore_errors=True)
        unfinished.mkdir()
        for archive in archives:
            tar = ['tar', '-x', '-f', archive, '-C', unfinished, '--no-same-owner']
            subprocess.run(tar, check=True)
        unfinished.rename(unpacked)
    (zlib,) = (tree for tree in unpacked.iterdir() if (tree / 'zlib.h').exists())
    (cpython,) = (tree for tree in unpacked.iterdir() if (tree / 'Python').exists())
    return zlib, cpython


def _steps(zlib: Path, cpython: Path, folder: Path) -> list[tuple[Path, list[str | Path]]]:
    configure: list[str | Path] = [
        './configure',
        # The loader of musl is here with its compiler: it is not built for another system.
        '--build=x86_64-linux-musl',
        f'--prefix={folder / "usr"}',
        '--without-ensurepip',
        '--disable-test-modules',
        '--with-pkg-config=no',
        f'ZLIB_CFLAGS=-I{zlib}',
        f'ZLIB_LIBS=-L{zlib} -lz',
        'OPT=-DNDEBUG -O1',
    ]
    return [
        (zlib, ['./configure', '--static']),
        (zlib, ['make', 'libz.a']),
        (cpython, configure),
        (cpython, ['make', f'-j{os.cpu_count()}']),
        (cpython, ['make', 'install']),
    ]
