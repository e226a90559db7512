"""For what wheels are built: the systems, and the versions of CPython whose headers are here."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from release.debian import own_python
from release.sources import ROOT

VERSIONS = ('3.10', '3.11', '3.12', '3.13', '3.14')


@dataclass(frozen=True)
class System:
    """What a wheel runs on, and what zig calls it."""

    machine: str
    libc: str

    @property
    def zig(self) -> str:
        # glibc 2.17 is the oldest that pip of Python 3.10 asks for: manylinux2014.
        return f'{self.machine}-linux-{"gnu.2.17" if self.libc == "gnu" else "musl"}'

    @property
    def tags(self) -> tuple[str, ...]:
        """Platform tags of PEP 600 and 656, in order; the musl that zig brings is 1.2."""
        if self.libc == 'gnu':
            return f'manylinux2014_{self.machine}', f'manylinux_2_17_{self.machine}'
        return (f'musllinux_1_2_{self.machine}',)

    def suffix(self, version: str) -> str:
        """How a module is named for one version, so that no other version loads it."""
        # CPython 3.10 calls itself gnu on musl too (bpo-43112 came with 3.11).
        libc = 'gnu' if version == '3.10' else self.libc
        return f'.cpython-{version.replace(".", "")}-{self.machine}-linux-{libc}.so'


SYSTEMS = tuple(
    System(machine, libc) for libc in ('gnu', 'musl') for machine in ('x86_64', 'aarch64')
)


@dataclass(frozen=True)
class Interpreter:
    """A CPython of this machine."""

    path: Path
    version: str
    include: Path
    pyconfig: Path


UNPACKED = ROOT / 'build' / 'debian'
# Debian keeps pyconfig.h of each architecture apart, and beside it one that asks which.
_ASK = """
import json, pathlib, platform, sys, sysconfig
include = pathlib.Path(sysconfig.get_path('include'))
apart = include.parent / str(sysconfig.get_config_var('MULTIARCH')) / include.name / 'pyconfig.h'
print(json.dumps([
    platform.python_implementation() == 'CPython' and not sysconfig.get_config_var('Py_DEBUG')
    and not sysconfig.get_config_var('Py_GIL_DISABLED') and sys.maxsize == 2**63 - 1,
    '%d.%d' % sys.version_info[:2],
    str(include),
    str(apart) if apart.exists() else sysconfig.get_config_h_filename(),
]))
"""


@cache
def interpreters() -> dict[str, Interpreter]:
    """
    Give one interpreter of each version that is here and has its headers.

    What is not installed is unpacked from Debian's packages, where a release has it.
    """
    found = {version: _interpreter(version) for version in VERSIONS}
    return {version: each for version, each in found.items() if each}


def _interpreter(version: str) -> Interpreter | None:
    for path in _candidates(version):
        interpreter = _asked(path)
        if interpreter and interpreter.version == version:
            return interpreter
    unpacked = own_python(version, UNPACKED)
    return _asked(unpacked) if unpacked else None


def _candidates(version: str) -> Iterator[Path]:
    pyenv = Path(os.environ.get('PYENV_ROOT', Path.home() / '.pyenv')) / 'versions'
    yield from sorted(pyenv.glob(f'{version}.*/bin/python{version}'))
    on_path = shutil.which(f'python{version}')
    if on_path:
        yield Path(on_path)
    yield Path(f'/usr/bin/python{version}')


def _asked(path: Path) -> Interpreter | None:
    try:
        answer = subprocess.run(
            [path, '-I', '-c', _ASK], capture_output=True, text=True, timeout=60, check=True
        )
    except (OSError, subprocess.SubprocessError):
        return None
    fits, version, include, pyconfig = json.loads(answer.stdout)
    if not fits or not Path(include, 'Python.h').exists() or not Path(pyconfig).exists():
        return None
    return Interpreter(path, version, Path(include), Path(pyconfig))


def headers_copied(interpreter: Interpreter, to: Path) -> Path:
    """
    Give a folder with the headers that serve every 64-bit Linux.

    The types that ``pyconfig.h`` describes have the same sizes on both machines and libraries.
    """
    folder = to / interpreter.version
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(interpreter.include, folder)
    shutil.copyfile(interpreter.pyconfig, folder / 'pyconfig.h')
    return folder
