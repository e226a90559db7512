"""Which domains may be used is said in the environment."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import pytest

from ros2cc_extract.confirm import processes
from ros2cc_extract.errors import InputError


@pytest.fixture(autouse=True)
def _alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No live test on this machine holds the domains of these tests."""
    monkeypatch.setattr(tempfile, 'tempdir', str(tmp_path))


def test_only_the_domains_that_are_named_are_used(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(processes.DOMAINS_VARIABLE, '61-62')
    with processes._domain() as first, processes._domain() as second:
        assert {first, second} == {61, 62}
        with pytest.raises(InputError, match='all domains of ROS are in use'):
            processes._domain().__enter__()


@pytest.mark.parametrize('text', ['x', '5', '9-3', '1-233', '-4', '1-2-3'])
def test_what_names_no_domains_is_refused(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(processes.DOMAINS_VARIABLE, text)
    with pytest.raises(InputError, match='names no domains'):
        processes._domain().__enter__()


@pytest.fixture
def lock(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The file of the only domain."""
    monkeypatch.setenv(processes.DOMAINS_VARIABLE, '61-61')
    return tmp_path / f'ros2cc-confirm-{os.getuid()}-61.lock'


def test_nothing_is_left_of_a_domain(lock: Path) -> None:
    for _ in range(2):
        with processes._domain() as domain:
            assert (domain, lock.exists()) == (61, True)
        assert list(lock.parent.iterdir()) == []


def test_a_link_that_somebody_has_put_there_is_not_followed(lock: Path) -> None:
    (lock.parent / 'kept').write_text('all of it')
    lock.symlink_to('kept')
    with pytest.raises(InputError, match='all domains of ROS are in use'):
        processes._domain().__enter__()
    assert (lock.parent / 'kept').read_text() == 'all of it'


def test_what_another_run_has_removed_is_not_held(lock: Path) -> None:
    with processes._held(lock) as first:
        old = lock.open('r+')
        lock.unlink()
        with processes._held(lock) as second:
            assert (first, second) == (True, True)
    with old:
        assert not processes._is_at(old.fileno(), lock)


def test_what_was_there_is_held_as_it_is(lock: Path) -> None:
    lock.write_text('something')
    with processes._domain():
        assert lock.read_text() == 'something'
