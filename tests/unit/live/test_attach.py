"""A process is entered by the first way that it lets in."""

from __future__ import annotations

import io
import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.extract.live.attach import attach_process
from ros2cc_extract.extract.live.injection import Injector, inject
from ros2cc_extract.extract.live.ptrace_entry import refuse_what_would_not_run_it

SCRIPT = Path('record.py')


class Door:
    """A way in, which refuses if it is given a reason; keeps all callers."""

    def __init__(self, name: str, refusal: str | None = None) -> None:
        self.entered: list[tuple[int, Path]] = []
        self._refusal = refusal
        self.injector = Injector(name, self._enter, (RuntimeError,))

    def _enter(self, pid: int, script: Path) -> None:
        if self._refusal is not None:
            raise RuntimeError(self._refusal)
        self.entered.append((pid, script))


def test_the_next_way_is_tried_when_one_is_refused() -> None:
    shut, opened = Door('sys.remote_exec', 'another version'), Door('pyinjector')
    inject(7, SCRIPT, (shut.injector, opened.injector))
    assert opened.entered == [(7, SCRIPT)]


def test_a_process_is_entered_once() -> None:
    first, second = Door('sys.remote_exec'), Door('pyinjector')
    inject(7, SCRIPT, (first.injector, second.injector))
    assert (first.entered, second.entered) == ([(7, SCRIPT)], [])


@pytest.mark.parametrize(
    ('names', 'told'),
    [
        (('sys.remote_exec', 'pyinjector'), 'sys.remote_exec: no; pyinjector: no; '),
        (('sys.remote_exec',), 'sys.remote_exec: no; .*pip install "pyinjector>=1.3"'),
    ],
)
def test_what_each_way_was_told_is_said_when_none_is_let_in(
    names: tuple[str, ...], told: str
) -> None:
    with pytest.raises(ToolNotFoundError) as raised:
        inject(7, SCRIPT, [Door(name, 'no').injector for name in names])
    assert re.match(f'process 7 cannot be entered: {told}', str(raised.value))


def test_other_errors_are_nobodys_refusal() -> None:
    def break_down(pid: int, script: Path) -> None:
        raise KeyError(pid)

    with pytest.raises(KeyError):
        inject(7, SCRIPT, [Injector('pyinjector', break_down, (OSError,)), Door('other').injector])


@pytest.mark.parametrize('number', [0, -1, os.getpid])
def test_groups_of_processes_are_no_process(
    number: int | Callable[[], int], tmp_path: Path
) -> None:
    pid = -number() if callable(number) else number
    with pytest.raises(InputError, match=f'{pid} is no process number'):
        attach_process(pid, tmp_path / 'live.yaml', io.StringIO())


def test_python_is_let_in() -> None:
    refuse_what_would_not_run_it(os.getpid())


def test_whole_pages_of_a_refusal_are_shortened() -> None:
    with pytest.raises(ToolNotFoundError) as raised:
        inject(7, SCRIPT, [Door('pyinjector', 'no way\n' * 200).injector])
    assert len(str(raised.value).splitlines()) == 1
    assert len(str(raised.value)) < 400


def test_folder_is_refused_before_a_process_is_entered(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='is a directory; name a file'):
        attach_process(os.getpid(), tmp_path, io.StringIO())
