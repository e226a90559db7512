"""Whatever lies in the cache folder: nothing of it runs, and results are those without it."""

from __future__ import annotations

import json
import os
import pickle
import random
import shutil
import subprocess
import sys
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from ros2cc_extract import cache_file
from tests.attack.conftest import Tally
from tests.attack.running import Ended
from tests.attack.test_attach import NOBODY, as_root
from tests.support.starting import run_command

CLASS = 'caches'

NODE = Path(__file__).parents[2] / 'launch_free_examples/service_deadlock/node.py'
CORRUPTIONS, CORRUPTIONS_OF_RECORD = 15, 1_000
EVIL, EVIL_OF_RECORD = 12, 1_000
# Many runs in one process: to start it takes longer than a run, and the caches are read each time.
RUN_MANY = """
import functools, io, json, sys
from ros2cc_extract import cache_file
from ros2cc_extract.checker.uppaal.language import parsing
from ros2cc_extract.cli.main import main
for line in sys.stdin:
    cache_file._own_folder.cache_clear()
    parsing._parser.cache_clear()
    parsing._tree.cache_clear()
    told, complaints = io.StringIO(), io.StringIO()
    status = main(json.loads(line), told, complaints)
    print(json.dumps([status, told.getvalue(), complaints.getvalue()]), flush=True)
"""


class Evil:
    """
    What makes its reader write a file.

    :param way: which of ``WAYS``.
    """

    def __init__(self, canary: Path, way: int = 0) -> None:
        self._canary = canary
        self._way = way

    def __reduce__(self) -> tuple[Callable[..., object], tuple[object, ...]]:
        return WAYS[self._way](str(self._canary))


WAYS: tuple[Callable[[str], tuple[Callable[..., object], tuple[object, ...]]], ...] = (
    lambda canary: (os.mkdir, (canary,)),
    lambda canary: (os.system, (f'mkdir {canary}',)),
    lambda canary: (exec, (f'import os; os.mkdir({canary!r})',)),
    lambda canary: (eval, (f'__import__("os").mkdir({canary!r})',)),
    lambda canary: (subprocess.call, (['mkdir', canary],)),
)
"""Before any of them is tried on the tool, a test sees that it works."""


@pytest.fixture(scope='module')
def filled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache that was filled by a check."""
    folder = tmp_path_factory.mktemp('filled')
    run(folder)
    assert len(list(entries(folder))) >= 3
    return folder


@pytest.fixture
def home(filled: Path, tmp_path: Path) -> Path:
    """The cache, for one test alone."""
    return shutil.copytree(filled, tmp_path, dirs_exist_ok=True)


def entries(home: Path) -> Iterator[Path]:
    return iter(sorted((home / 'ros2cc-extract').iterdir()))


def environment(home: Path) -> dict[str, str]:
    """Where no bytecode is kept, what would stand beside it is in the cache too."""
    return {**os.environ, 'XDG_CACHE_HOME': str(home), 'PYTHONDONTWRITEBYTECODE': '1'}


def run(home: Path, *options: str) -> Ended:
    done = run_command([NODE, *options], cwd=Path.cwd(), env=environment(home))
    return Ended(done.returncode, done.stdout.decode(), done.stderr.decode())


def test_a_pickle_in_the_cache_is_not_run(home: Path, tmp_path: Path) -> None:
    before, canary = run(home, '--no-cache'), tmp_path / 'canary'
    for entry in entries(home):
        header = entry.read_bytes().partition(b'\n')[0]
        entry.write_bytes(pickle.dumps(Evil(canary)))
        assert run(home) == before
        entry.write_bytes(header + b'\n' + pickle.dumps(Evil(canary)))
        assert run(home) == before
    assert not canary.exists()


@pytest.mark.parametrize('way', range(len(WAYS)))
def test_an_evil_pickle_is_evil(way: int, tmp_path: Path) -> None:
    pickle.loads(pickle.dumps(Evil(tmp_path / 'canary', way)))
    assert (tmp_path / 'canary').exists()


@pytest.mark.parametrize('rounds', [EVIL, pytest.param(EVIL_OF_RECORD, marks=pytest.mark.slow)])
def test_no_evil_entry_is_run(rounds: int, home: Path, tmp_path: Path, tally: Tally) -> None:
    """Whatever it does, wherever it stands, and also where its checksum is right."""
    chance, pristine, canary = random.Random(rounds), home / 'pristine', tmp_path / 'canary'
    (home / 'ros2cc-extract').rename(pristine)
    with many_runs(home) as ask:
        before = ask('--no-cache')
        for number in range(rounds):
            shutil.rmtree(home / 'ros2cc-extract', ignore_errors=True)
            shutil.copytree(pristine, home / 'ros2cc-extract')
            way, protocol = chance.randrange(len(WAYS)), chance.randrange(6)
            evil = pickle.dumps(Evil(canary, way), protocol)
            put = chance.choice(PUTS)
            for entry in chance.sample(list(entries(home)), chance.randint(1, 3)):
                put(entry, chance.choice(WRAPPED)(evil))
            tally.add()
            assert ask() == before, f'{number}: {put.__name__}'
            assert not canary.exists(), f'{number}: {put.__name__}, way {way}'


def instead(entry: Path, evil: bytes) -> None:
    entry.write_bytes(evil)


def behind_its_header(entry: Path, evil: bytes) -> None:
    entry.write_bytes(entry.read_bytes().partition(b'\n')[0] + b'\n' + evil)


def behind_its_content(entry: Path, evil: bytes) -> None:
    entry.write_bytes(entry.read_bytes() + evil)


def with_a_right_checksum(entry: Path, evil: bytes) -> None:
    """As only the user could write it."""
    cache_file.store_content(entry, evil)


def under_an_old_name(entry: Path, evil: bytes) -> None:
    for name in (
        'uppaal-grammar.cache',
        f'{entry.stem}.pickle',
        f'{entry.stem}.pyc',
        'lark.cache',
    ):
        (entry.parent / name).write_bytes(evil)
        cache_file.store_content(entry.parent / name, evil)


PUTS = (instead, behind_its_header, behind_its_content, with_a_right_checksum, under_an_old_name)
WRAPPED: tuple[Callable[[bytes], bytes], ...] = (
    bytes,
    lambda evil: b'0' * 64 + b'\n' + evil,
    zlib.compress,
    lambda evil: json.dumps({'py/reduce': [evil.hex()], '__class__': 'os.system'}).encode(),
)


def test_a_pickle_where_lark_had_its_tables_is_not_run(tmp_path: Path) -> None:
    canary, folder = tmp_path / 'canary', tmp_path / 'ros2cc-extract'
    folder.mkdir(mode=0o700)
    evil = b'0' * 64 + b'\n' + pickle.dumps(Evil(canary))
    (folder / 'uppaal-grammar.cache').write_bytes(evil)
    assert run(tmp_path).status == 1
    assert not canary.exists()


@pytest.mark.parametrize('mode', [0o777, 0o770, 0o722])
def test_a_folder_that_others_may_write_into_is_not_read_and_told(mode: int, home: Path) -> None:
    before, folder = run(home, '--no-cache'), home / 'ros2cc-extract'
    folder.chmod(mode)
    read = {entry: entry.stat().st_mtime_ns for entry in entries(home)}
    after = run(home)
    assert (after.status, after.out) == (before.status, before.out)
    assert f'{folder}: not used as a cache, as other users can change {folder}' in after.err
    assert {entry: entry.stat().st_mtime_ns for entry in entries(home)} == read


@as_root
@pytest.mark.parametrize('level', ['ros2cc-extract', '.'])
def test_a_folder_of_another_user_is_not_read(level: str, home: Path) -> None:
    before = run(home, '--no-cache')
    os.chown(home / level, NOBODY, NOBODY)
    read = {entry: entry.stat().st_mtime_ns for entry in entries(home)}
    after = run(home)
    assert (after.status, after.out) == (before.status, before.out)
    assert 'not used as a cache, as other users can change' in after.err
    assert {entry: entry.stat().st_mtime_ns for entry in entries(home)} == read


def chmod(entry: Path) -> None:
    entry.chmod(0o666)


def chown(entry: Path) -> None:
    os.chown(entry, NOBODY, NOBODY)


def link(entry: Path) -> None:
    entry.rename(entry.parent.parent / entry.name)
    entry.symlink_to(entry.parent.parent / entry.name)


def pipe(entry: Path) -> None:
    entry.unlink()
    os.mkfifo(entry)


@pytest.mark.parametrize('change', [chmod, pytest.param(chown, marks=as_root), link, pipe])
def test_a_file_that_is_not_ours_alone_is_not_read(
    change: Callable[[Path], None], home: Path
) -> None:
    for entry in entries(home):
        content = cache_file.load_content(entry)
        assert content
        change(entry)
        assert cache_file.load_content(entry) is None
        cache_file.store_content(entry, content)
        assert cache_file.load_content(entry) == content


@pytest.mark.parametrize(
    'rounds', [CORRUPTIONS, pytest.param(CORRUPTIONS_OF_RECORD, marks=pytest.mark.slow)]
)
def test_the_result_of_a_damaged_cache_is_that_without_one(
    rounds: int, home: Path, tally: Tally
) -> None:
    chance, pristine = random.Random(rounds), home / 'pristine'
    (home / 'ros2cc-extract').rename(pristine)
    with many_runs(home) as ask:
        before = ask('--no-cache')
        for number in range(rounds):
            shutil.rmtree(home / 'ros2cc-extract', ignore_errors=True)
            shutil.copytree(pristine, home / 'ros2cc-extract')
            done = chance.choice(DAMAGES)(home / 'ros2cc-extract', chance)
            tally.add()
            assert ask() == before, f'{number}: {done}'


@contextmanager
def many_runs(home: Path) -> Iterator[Callable[..., str]]:
    with subprocess.Popen(
        [sys.executable, '-c', RUN_MANY],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=environment(home),
    ) as process:
        assert process.stdin is not None and process.stdout is not None
        lines, answers = process.stdin, process.stdout

        def ask(*options: str) -> str:
            print(json.dumps([str(NODE), *options]), file=lines, flush=True)
            answer = answers.readline()
            assert json.loads(answer)[0] == 1
            return answer

        yield ask
        lines.close()


def flip_bits(folder: Path, chance: random.Random) -> str:
    entry, content = picked(folder, chance)
    bits = [chance.randrange(8 * len(content)) for _ in range(chance.randint(1, 14))]
    for bit in bits:
        content[bit // 8] ^= 1 << bit % 8
    entry.write_bytes(content)
    return f'{entry.name}: bits {bits}'


def cut(folder: Path, chance: random.Random) -> str:
    entry, content = picked(folder, chance)
    length = chance.randrange(len(content))
    entry.write_bytes(content[:length])
    return f'{entry.name}: {length} bytes left'


def overwrite(folder: Path, chance: random.Random) -> str:
    entry, content = picked(folder, chance)
    start, noise = chance.randrange(len(content)), chance.randbytes(chance.randint(1, 64))
    entry.write_bytes(content[:start] + noise + content[start + len(noise) :])
    return f'{entry.name}: {noise!r} at {start}'


def splice(folder: Path, chance: random.Random) -> str:
    (one, first), (_, second) = picked(folder, chance), picked(folder, chance)
    one.write_bytes(first[: len(first) // 2] + second[len(second) // 2 :])
    return f'{one.name}: half of another'


def swap(folder: Path, chance: random.Random) -> str:
    one, other = chance.sample(sorted(folder.iterdir()), 2)
    first, second = one.read_bytes(), other.read_bytes()
    one.write_bytes(second)
    other.write_bytes(first)
    return f'{one.name} and {other.name}'


def picked(folder: Path, chance: random.Random) -> tuple[Path, bytearray]:
    entry = chance.choice(sorted(folder.iterdir()))
    return entry, bytearray(entry.read_bytes())


DAMAGES = (flip_bits, cut, overwrite, splice, swap)
