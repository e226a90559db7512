"""One input, one output: cold and warm, on any number of cores, in any order of arguments."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.e2e.conftest import environment
from tests.support.trees import write_tree

OTHERS = ('json', 'sarif', 'junit', 'github')


def checked(folder: Path, cache: Path, cores: int, *arguments: object) -> tuple[int, bytes]:
    allowed = ','.join(map(str, sorted(os.sched_getaffinity(0))[:cores]))
    done = subprocess.run(
        ['taskset', '-c', allowed, sys.executable, '-m', 'ros2cc_extract.cli.main', 'check']
        + [str(argument) for argument in arguments],
        cwd=folder,
        env=environment(cache),
        capture_output=True,
        check=False,
    )
    assert done.stderr == b''
    return done.returncode, done.stdout


FORMS = ['text', 'html', *(pytest.param(form, marks=pytest.mark.slow) for form in OTHERS)]


@pytest.mark.parametrize('form', FORMS)
def test_check_says_the_same_every_time(tmp_path: Path, form: str) -> None:
    folder = tmp_path / 'tree'
    write_tree(folder)
    told = ['--output-format', form]
    paths: Sequence[object] = ['one', 'two/arm_0.py', 'two/arm_1.py']
    expected = checked(folder, tmp_path / 'a', 1, *told, *paths)
    assert expected[0] == 1
    assert checked(folder, tmp_path / 'a', 2, *told, *paths) == expected
    assert checked(folder, tmp_path / 'b', 2, *told, *paths[::-1]) == expected
    assert checked(folder, tmp_path / 'b', 1, *told, '--no-cache', *paths) == expected


def test_damaged_cache_counts_as_none(tmp_path: Path) -> None:
    folder = tmp_path / 'tree'
    write_tree(folder)
    expected = checked(folder, tmp_path / 'a', 2, 'one')
    entries = list((tmp_path / 'a').rglob('*.verdicts'))
    assert len(entries) == 6
    for entry in entries:
        entry.write_bytes(b'damaged')
    assert checked(folder, tmp_path / 'a', 2, 'one') == expected


def test_only_the_changed_unit_is_verified_again(tmp_path: Path) -> None:
    folder = tmp_path / 'tree'
    write_tree(folder)
    checked(folder, tmp_path / 'a', 2, 'one')
    before = {entry.name for entry in (tmp_path / 'a').rglob('*.verdicts')}
    path = folder / 'one' / 'arm_1.py'
    path.write_text(path.read_text().replace('0.5', '0.7'))
    checked(folder, tmp_path / 'a', 2, 'one')
    assert len({entry.name for entry in (tmp_path / 'a').rglob('*.verdicts')} - before) == 1
