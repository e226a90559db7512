"""A CPython of another machine out of Debian's packages, unpacked into a folder; nobody's root."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

KEYS = Path('/usr/share/keyrings/debian-archive-keyring.gpg')
SUITES = {'3.11': 'bookworm', '3.13': 'trixie'}
"""Versions of CPython that a stable release of Debian has."""
PACKAGES = ('python3-minimal', 'libpython3-stdlib', 'libc6', 'libstdc++6')
SETTINGS = """
Dir::State "{folder}/state"; Dir::State::status "{folder}/state/status";
Dir::Cache "{folder}/cache"; Dir::Etc "{folder}/etc"; Dir::Etc::sourceparts "-";
APT::Architecture "arm64"; APT::Architectures "arm64"; Acquire::Languages "none";
"""


def emulator() -> str | None:
    return shutil.which('qemu-aarch64-static')


def aarch64_python(version: str, work: Path) -> list[str] | None:
    """Give the command of an aarch64 CPython; nothing where there is none."""
    suite = SUITES.get(version)
    qemu = emulator()
    if not suite or not qemu or not shutil.which('apt-get') or not _archive():
        return None
    root = work / f'{suite}-arm64'
    command = [qemu, '-L', str(root), str(root / f'usr/bin/python{version}')]
    if not (root / 'complete').exists() and not _unpack(suite, root, work / f'{suite}-apt'):
        return None
    return command


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


def _unpack(suite: str, root: Path, folder: Path) -> bool:
    shutil.rmtree(root, ignore_errors=True)
    # Releases from 12 on have these as links, which the packages leave to the installer.
    for name in ('bin', 'lib', 'sbin'):
        (root / 'usr' / name).mkdir(parents=True)
        (root / name).symlink_to(f'usr/{name}')
    for part in ('state/lists/partial', 'cache/archives/partial', 'etc/apt.conf.d'):
        (folder / part).mkdir(parents=True, exist_ok=True)
    (folder / 'state/status').touch()
    (folder / 'apt.conf').write_text(SETTINGS.format(folder=folder), encoding='utf-8')
    source = f'deb [signed-by={KEYS}] {_archive()} {suite} main\n'
    (folder / 'etc/sources.list').write_text(source, encoding='utf-8')
    environment = {**os.environ, 'APT_CONFIG': str(folder / 'apt.conf')}
    fetch = ['apt-get', '-qq', '-y', '--no-install-recommends', '--download-only', 'install']
    for command in (['apt-get', '-qq', 'update'], [*fetch, *PACKAGES]):
        if subprocess.run(command, env=environment, capture_output=True).returncode:
            return False
    for package in sorted((folder / 'cache/archives').glob('*.deb')):
        # Not dpkg -x: that would put folders in the place of the links.
        unpacked = subprocess.run(['dpkg-deb', '--fsys-tarfile', package], capture_output=True)
        tar = ['tar', '-x', '--keep-directory-symlink', '--no-same-owner', '-C', root]
        subprocess.run(tar, input=unpacked.stdout, check=True)
    (root / 'complete').touch()
    return True
