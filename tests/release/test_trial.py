"""What a trial of a wheel accepts, and what it does not."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from release.demonstration import CHECKER, FINDING, FOUND, differing
from release.trial import told_to_pip, unbound, wheel_of

SAID = f'  20 states ({CHECKER})\n{FINDING} drive waits\n{FOUND}\n'


def test_the_result_that_is_known_is_accepted() -> None:
    assert differing(1, SAID, '') == ''


@pytest.mark.parametrize(
    ('status', 'stdout', 'stderr', 'told'),
    [
        (0, SAID, '', 'exit status 0'),
        (1, SAID.replace(':44:', ':45:'), '', f'no "{FINDING}"'),
        (1, SAID.replace('1 note', '2 notes'), '', f'no "{FOUND}"'),
        (1, SAID.replace('native', 'reference'), '', f'no "{CHECKER}"'),
        (1, SAID, 'the core did not load\n', 'stderr: the core did not load'),
    ],
)
def test_another_result_is_told(status: int, stdout: str, stderr: str, told: str) -> None:
    assert differing(status, stdout, stderr) == told


def test_only_the_symbols_of_the_interpreter_may_be_missing() -> None:
    own = 'Error relocating _core.so: {}: symbol not found'
    lines = [own.format(name) for name in ('PyList_New', '_Py_Dealloc', '__memcpy_chk')]
    lines.append('Error loading shared library libstdc++.so.6: No such file or directory')
    command = [sys.executable, '-c', f'import sys; print(*{lines}, sep=chr(10), file=sys.stderr)']
    assert unbound(command) == lines[2:]


def test_pip_is_told_of_the_system_that_a_wheel_is_for(tmp_path: Path) -> None:
    name = 'ros2cc_extract-0.1.0-cp313-cp313-musllinux_1_2_x86_64.whl'
    told = told_to_pip(wheel_of(tmp_path / name), tmp_path / 'site')
    assert '--platform=musllinux_1_2_x86_64' in told
    assert '--python-version=3.13' in told
    assert not any('manylinux' in each for each in told)
    name = 'ros2cc_extract-0.1.0-cp311-cp311-manylinux2014_aarch64.manylinux_2_17_aarch64.whl'
    told = told_to_pip(wheel_of(tmp_path / name), tmp_path / 'site')
    assert '--platform=manylinux_2_28_aarch64' in told
    assert not any('musllinux' in each for each in told)
