"""Nobody but the two users concerned can bring code into a process through ``attach``."""

from __future__ import annotations

import contextlib
import io
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from multiprocessing.process import BaseProcess
from pathlib import Path

import pytest

from ros2cc_extract.errors import InputError, Ros2ccError
from ros2cc_extract.extract.live import attach
from ros2cc_extract.extract.live.attach import attach_process
from ros2cc_extract.extract.live.injection import Injector, private_folder
from ros2cc_extract.file_ownership import open_to_others, user_of_process
from tests.attack.conftest import Tally
from tests.attack.rename import replace_scripts

CLASS = 'attach'

NOBODY = 65534
ROUNDS, ROUNDS_OF_RECORD = 10, 1_000
# A main thread that is back from C a little later, as a process that is entered is.
RUNS_LATER = 'import sys, time; time.sleep(0.02); exec(open(sys.argv[1]).read(), {})'

as_root = pytest.mark.skipif(os.geteuid() != 0, reason='only root can act as another user')


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder for temporary files as ``/tmp`` is one."""
    with tempfile.TemporaryDirectory(prefix='attack-', dir='/tmp') as folder:
        Path(folder).chmod(0o1777)
        monkeypatch.setattr(tempfile, 'tempdir', folder)
        yield Path(folder)


@pytest.fixture
def entered_later(monkeypatch: pytest.MonkeyPatch) -> None:
    def enter(pid: int, script: Path) -> None:
        subprocess.run([sys.executable, '-c', RUNS_LATER, str(script)], check=True)

    monkeypatch.setattr(attach, 'injectors', lambda: (Injector('later', enter, (OSError,)),))
    monkeypatch.setattr(attach, 'PATIENCE_S', 0.2)


def as_nobody(act: Callable[..., None], *values: Path | float) -> BaseProcess:
    """Start a process of another user; forked, since our interpreter may not be theirs to run."""

    def run() -> None:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
        act(*values)

    process = multiprocessing.get_context('fork').Process(target=run, daemon=True)
    process.start()
    return process


@pytest.fixture
def somebody_else() -> Iterator[int]:
    """The number of a process of another user."""
    process = as_nobody(time.sleep, 60)
    assert process.pid is not None
    while user_of_process(process.pid) != NOBODY:
        time.sleep(0.01)
    yield process.pid
    process.kill()
    process.join()


@contextlib.contextmanager
def attacker(temporary: Path, canary: Path) -> Iterator[None]:
    looks = temporary / 'looks'
    process = as_nobody(replace_scripts, temporary, canary, looks)
    try:
        while not looks.exists():
            assert process.is_alive()
            time.sleep(0.01)
        yield
        assert process.is_alive()
    finally:
        process.kill()
        process.join()


@as_root
@pytest.mark.usefixtures('entered_later')
@pytest.mark.parametrize(
    'rounds', [ROUNDS, pytest.param(ROUNDS_OF_RECORD, marks=pytest.mark.slow)]
)
def test_a_local_user_cannot_replace_the_script(
    rounds: int, temporary: Path, tmp_path: Path, tally: Tally
) -> None:
    canary = temporary / 'canary'
    with attacker(temporary, canary):
        for _ in range(rounds):
            tally.add()
            with contextlib.suppress(Ros2ccError):
                attach_process(os.getpid(), tmp_path / 'attached.yaml', io.StringIO())
    assert not canary.exists()


@as_root
def test_a_process_of_another_user_is_not_entered_unasked(
    somebody_else: int, tmp_path: Path
) -> None:
    told = f'process {somebody_else} belongs to user {NOBODY}, and you are user 0'
    with pytest.raises(InputError, match=told):
        attach_process(somebody_else, tmp_path / 'attached.yaml', io.StringIO())


@as_root
def test_a_user_that_may_answer_cannot_make_root_read_or_write_elsewhere(
    somebody_else: int,
    temporary: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    secret = tmp_path / 'secret'
    secret.write_text('root knows this')

    def answer_by_links(pid: int, script: Path) -> None:
        assert script.parent.stat().st_uid == NOBODY
        answering = as_nobody(os.symlink, secret, script.parent / f'{pid}.json.failed')
        answering.join()
        assert answering.exitcode == 0

    ways = (Injector('links', answer_by_links, (OSError,)),)
    monkeypatch.setattr(attach, 'injectors', lambda: ways)
    with pytest.raises(InputError, match='could not be recorded') as refused:
        attach_process(somebody_else, tmp_path / 'attached.yaml', io.StringIO(), other_user=True)
    assert 'root knows this' not in str(refused.value)
    assert secret.read_text() == 'root knows this'
    assert list(temporary.iterdir()) == []


def test_a_folder_where_others_rename_is_not_used(temporary: Path) -> None:
    temporary.chmod(0o777)
    assert open_to_others(temporary) == temporary
    with (
        pytest.raises(InputError, match=f'{temporary} lets other users replace'),
        private_folder(),
    ):
        pass
    temporary.chmod(0o1777)
    with private_folder() as folder:
        assert folder.stat().st_mode & 0o777 == 0o700
        assert open_to_others(folder) is None


@as_root
def test_a_folder_below_one_of_another_user_is_theirs(temporary: Path) -> None:
    inner = temporary / 'inner'
    inner.mkdir(mode=0o700)
    os.chown(temporary, NOBODY, -1)
    assert open_to_others(inner) == temporary


def test_the_user_of_a_process() -> None:
    assert user_of_process(os.getpid()) == os.geteuid()
