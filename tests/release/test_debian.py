"""What was unpacked of Debian's packages before: used where it is what is asked for."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from release import debian

WANTED = ['python3.14-minimal', 'libpython3.14-dev']


@pytest.fixture
def unpacked(monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """The folders that were unpacked, in turn, by a stand-in that fetches nothing."""
    folders: list[Path] = []

    def unpack(suite: str, name: str, packages: list[str], root: Path) -> bool:
        shutil.rmtree(root, ignore_errors=True)
        root.mkdir(parents=True)
        for package in packages:
            (root / package).touch()
        folders.append(root)
        return True

    monkeypatch.setattr(debian, '_unpack', unpack)
    monkeypatch.setattr(debian, '_archive', lambda: 'http://debian.invalid')
    monkeypatch.setattr('shutil.which', lambda name: name)
    return folders


def test_what_is_asked_for_again_is_not_unpacked_again(
    tmp_path: Path, unpacked: list[Path]
) -> None:
    for _ in range(2):
        assert debian._of_suite('forky', 'amd64', WANTED, tmp_path / 'here') == tmp_path / 'here'
    assert unpacked == [tmp_path / 'here']


def test_a_folder_that_was_unpacked_without_the_headers_is_made_anew(
    tmp_path: Path, unpacked: list[Path]
) -> None:
    root = tmp_path / 'here'
    debian._of_suite('forky', 'amd64', WANTED[:1], root)
    debian._of_suite('forky', 'amd64', WANTED, root)
    assert unpacked == [root, root]
    assert (root / WANTED[1]).exists()


def test_a_folder_that_was_moved_is_made_anew(tmp_path: Path, unpacked: list[Path]) -> None:
    """Its interpreter is bound to the loader at the place where it was."""
    debian._of_suite('forky', 'amd64', WANTED, tmp_path / 'there')
    (tmp_path / 'there').rename(tmp_path / 'here')
    debian._of_suite('forky', 'amd64', WANTED, tmp_path / 'here')
    assert unpacked == [tmp_path / 'there', tmp_path / 'here']
