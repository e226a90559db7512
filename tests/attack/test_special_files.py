"""What is no regular file, or too large, is reported and neither waited for nor read."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from ros2cc_extract.files import DISK, read_regular
from tests.attack.running import assert_orderly, run_tool
from tests.support.packages import DEADLOCK, MENDED
from tests.support.products import every_pair

CLASS = 'special files'

WITHOUT_RIGHTS = ('setpriv', '--inh-caps=-all', '--bounding-set=-all')
"""Root that may not read everything, as any other user."""

as_root = pytest.mark.skipif(
    os.geteuid() == 0 and shutil.which(WITHOUT_RIGHTS[0]) is None,
    reason='root may read everything',
)


def make_socket(path: Path) -> None:
    here = Path.cwd()
    os.chdir(path.parent)  # such a name may only be short
    try:
        with socket.socket(socket.AF_UNIX) as made:
            made.bind(path.name)
    finally:
        os.chdir(here)


def make_sparse(path: Path) -> None:
    with path.open('wb') as stream:
        stream.truncate(50 * 10**9)


KINDS: dict[str, Callable[[Path], None]] = {
    'fifo': os.mkfifo,
    'device': lambda path: path.symlink_to('/dev/zero'),
    'sparse': make_sparse,
    'socket': make_socket,
    'folder': Path.mkdir,
    'dangling': lambda path: path.symlink_to('nowhere'),
    'loop': lambda path: path.symlink_to(path.name),
    'terminal': lambda path: path.symlink_to('/dev/tty'),
    'process': lambda path: path.symlink_to('/proc/self/mem'),
}
COMMON = ('fifo', 'device', 'sparse')


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    made = tmp_path / 'package'
    made.mkdir()
    (made / 'clean.py').write_text(MENDED)
    return made


@pytest.mark.parametrize(('kind', 'command'), every_pair(KINDS, ['check', 'spec']))
def test_a_special_file_among_others_is_told(command: str, kind: str, folder: Path) -> None:
    KINDS[kind](folder / 'evil.py')
    plain = run_tool(command, '.', cwd=folder)
    strict = run_tool(command, '.', '--strict', cwd=folder)
    assert_orderly(plain)
    assert_orderly(strict)
    if kind == 'folder':
        assert (plain.status, strict.status) == (0, 0)
        return
    assert 'evil.py: ' in plain.told
    assert plain.status == 0
    assert strict.status == (3 if kind == 'sparse' else 2)


@pytest.mark.parametrize('kind', KINDS)
def test_a_special_file_that_is_named_is_an_error(kind: str, folder: Path) -> None:
    KINDS[kind](folder / 'evil.py')
    ended = run_tool('evil.py', cwd=folder)
    assert_orderly(ended)
    assert (ended.status, 'evil.py: ' in ended.told) == (2, True)


@pytest.mark.parametrize(
    ('name', 'kind'),
    every_pair(['__init__.py', 'setup.py', 'setup.cfg', 'package.xml'], COMMON),
)
def test_files_around_a_node_do_no_harm(name: str, kind: str, folder: Path) -> None:
    (folder / 'node.py').write_text(f'import helper\n{DEADLOCK}')
    KINDS[kind](folder / name)
    for command in ('check', 'spec'):
        ended = run_tool(command, '.', cwd=folder)
        assert_orderly(ended)
        assert 'node.py' in ended.told


NAMED = [
    'check clean.py --baseline evil.json',
    'check clean.py --assume threads=2',
    'collect .',
    'verify evil.xml',
    'verify model.xml evil.q',
    'verify evil.json',
    'merge clean.py evil.json',
    'diff clean.py evil.json',
    'spec --check evil.xml clean.py',
    'conform evil.json clean.py',
    'init sub',
]


@pytest.mark.parametrize(('command', 'kind'), every_pair(NAMED, COMMON))
def test_special_files_that_are_named(command: str, kind: str, folder: Path) -> None:
    arguments = command.split()
    shutil.copy(Path(__file__).parents[1] / 'models' / 'peterson.xml', folder / 'model.xml')
    (folder / 'sub').mkdir()
    for name in ('evil.json', 'evil.xml', 'evil.q', 'sub/package.xml', 'pyproject.toml'):
        KINDS[kind](folder / name)
    ended = run_tool(*arguments, cwd=folder)
    assert_orderly(ended)
    is_told = 'cannot be read' in ended.err or kind != 'sparse'
    if '--assume' in arguments and kind != 'sparse':
        assert ended.status == 0  # no settings
    else:
        assert (ended.status, is_told) == (2, True), ended.err
        assert len(ended.err.splitlines()) == (2 if 'collect' in arguments else 1)


def test_a_specification_may_still_come_through_a_pipe(folder: Path) -> None:
    spec = run_tool('spec', 'clean.py', cwd=folder).out
    os.mkfifo(folder / 'pipe')
    writer = subprocess.Popen(
        [sys.executable, '-c', 'import sys; open("pipe", "w").write(sys.argv[1])', spec],
        cwd=folder,
    )
    try:
        assert run_tool('verify', 'pipe', cwd=folder).status in (0, 1)
    finally:
        writer.kill()
        writer.wait()


def test_a_file_that_grows_is_read_up_to_the_limit(tmp_path: Path) -> None:
    path = tmp_path / 'grows'
    path.write_bytes(b'x' * 1000)
    assert read_regular(path, 1000) == b'x' * 1000
    for name in ('/proc/self/environ', '/proc/self/maps'):  # their sizes are not given
        with pytest.raises(OSError, match='larger than 10 bytes'):
            read_regular(Path(name), 10)


def test_no_descriptor_is_left_open(tmp_path: Path) -> None:
    def open_now() -> int:
        return sum(1 for _ in Path('/proc/self/fd').iterdir())

    before = open_now()
    for kind, make in KINDS.items():
        make(tmp_path / kind)
        with pytest.raises(OSError, match=r'.'):
            read_regular(tmp_path / kind, 100)
    assert open_now() == before


@pytest.mark.parametrize(
    ('mode', 'barred'), [(0o000, True), (0o600, False), (0o100, True)], ids=oct
)
@as_root
def test_an_unreadable_folder_is_told_and_weighs(mode: int, barred: bool, folder: Path) -> None:
    hidden = folder / 'hidden'
    hidden.mkdir()
    (hidden / 'node.py').write_text(DEADLOCK)
    hidden.chmod(mode)
    prefix = WITHOUT_RIGHTS if os.geteuid() == 0 else ()
    plain = run_tool('check', '.', cwd=folder, prefix=prefix)
    strict = run_tool('check', '.', '--strict', cwd=folder, prefix=prefix)
    of_spec = run_tool('spec', '.', '--strict', cwd=folder, prefix=prefix)
    alone = run_tool('check', 'hidden', cwd=folder, prefix=prefix)
    hidden.chmod(0o700)
    where = 'hidden' if barred else 'hidden/node.py'
    told = f'{where}: error CC500: cannot be'
    assert told in plain.out
    assert (plain.status, strict.status, of_spec.status, alone.status) == (0, 2, 2, 2)


@as_root
def test_an_unreadable_folder_among_launch_files_is_told(folder: Path) -> None:
    """One that only the search for launch files would come by."""
    launch = folder / 'arm.launch.xml'
    launch.write_text('<launch/>')
    (folder / 'hidden').mkdir(mode=0o000)
    prefix = WITHOUT_RIGHTS if os.geteuid() == 0 else ()
    plain = run_tool('system', '.', cwd=folder, prefix=prefix)
    strict = run_tool('system', '.', '--strict', cwd=folder, prefix=prefix)
    (folder / 'hidden').chmod(0o700)
    assert 'hidden: error: cannot be looked into' in plain.err
    assert (plain.status, strict.status) == (0, 2)


@as_root
def test_the_linter_fails_on_an_unreadable_folder(folder: Path) -> None:
    hidden = folder / 'hidden'
    hidden.mkdir(mode=0o000)
    prefix = WITHOUT_RIGHTS if os.geteuid() == 0 else ()
    done = subprocess.run(
        [*prefix, sys.executable, '-m', 'ros2cc_extract.ros.ament', '.'],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert 'hidden: error CC500: cannot be looked into' in done.stdout


@pytest.fixture
def abyss(folder: Path) -> Iterator[Path]:
    """Folders within folders, deeper than any path may be long."""
    here = Path.cwd()
    os.chdir(folder)
    try:
        for _ in range(30):
            Path('d' * 250).mkdir()
            os.chdir('d' * 250)
        Path('node.py').write_text(DEADLOCK)
        os.chdir(here)
        yield folder
    finally:
        os.chdir(here)
        subprocess.run(['rm', '-rf', str(folder)], check=True)


def test_a_path_that_is_too_long_is_told_and_weighs(abyss: Path) -> None:
    plain = run_tool('check', '.', cwd=abyss)
    strict = run_tool('check', '.', '--strict', cwd=abyss)
    assert 'CC500: cannot be looked into: File name too long' in plain.out
    assert (plain.status, strict.status) == (0, 2)


def test_a_name_that_is_too_long_is_no_file(tmp_path: Path) -> None:
    for path in (tmp_path / ('x' * 300), tmp_path / 'a\0b'):
        assert not DISK.exists(path)
        assert not DISK.is_file(path)
        assert not DISK.is_folder(path)
