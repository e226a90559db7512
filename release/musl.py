"""
A CPython on musl, built of Debian's sources: no release of Debian has one.

It is for trials alone: without ``ssl`` and ``ctypes``, and barely optimised. ``musl-gcc`` of the
package ``musl-tools`` compiles it, a minute or two of CPU for each version.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from release.debian import SUITES, fetched_sources

COMPILER = 'musl-gcc'
# As CPython's configure asks gcc, which would name the system that it runs on.
WRAPPER = """#!/bin/sh
case " $* " in *" --print-multiarch "*) echo x86_64-linux-musl; exit 0;; esac
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
    python = folder / f'usr/bin/python{version}'
    if python.exists():
        return python
    is_possible = os.uname().machine == 'x86_64' and shutil.which(COMPILER)
    if not is_possible or version not in SUITES:
        return None
    shutil.rmtree(folder, ignore_errors=True)
    sources = fetched_sources(SUITES[version], [f'python{version}', 'zlib'], folder / 'sources')
    if not sources:
        return None
    for name, headers in KERNEL.items():
        (folder / 'kernel').mkdir(exist_ok=True)
        (folder / 'kernel' / name).symlink_to(headers)
    compiler = folder / 'compiler'
    compiler.write_text(WRAPPER, encoding='utf-8')
    compiler.chmod(0o755)
    trees = [_unpacked(archive) for archive in sources]
    (zlib,) = (tree for tree in trees if (tree / 'zlib.h').exists())
    (cpython,) = (tree for tree in trees if (tree / 'Python').exists())
    with (folder / 'output').open('w', encoding='utf-8') as output:
        for tree, command in _steps(zlib, cpython, folder):
            environment = {**os.environ, 'CC': str(compiler), 'CXX': str(compiler)}
            environment |= {'CFLAGS': f'-O1 -fPIC -isystem {folder / "kernel"}'}
            done = subprocess.run(
                command, cwd=tree, env=environment, stdout=output, stderr=subprocess.STDOUT
            )
            if done.returncode:
                print(f'CPython {version} on musl: see {folder / "output"}', file=sys.stderr)
                return None
    return python if python.exists() else None


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


def _unpacked(archive: Path) -> Path:
    to = archive.with_name(f'{archive.name}-unpacked')
    to.mkdir()
    subprocess.run(['tar', '-x', '-f', archive, '-C', to, '--no-same-owner'], check=True)
    (tree,) = to.iterdir()
    return tree
