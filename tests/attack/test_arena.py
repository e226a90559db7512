"""The arena sees what it is for: each of these gives way, in a way of its own."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.attack import arena as watched
from tests.attack.arena import Attempt, Found, arena, judged

CLASS = 'of the harness itself'
ENDED = {
    'status': 0,
    'out': '',
    'err': '',
    'crash': '',
    'seconds': 1.0,
    'megabytes': 50.0,
    'left': [],
}


def nothing(folder: Path) -> None:
    """An empty folder."""


@pytest.mark.parametrize(
    ('changes', 'kind'),
    [
        ({}, None),
        ({'crash': 'Traceback'}, 'crash'),
        ({'status': None}, 'crash'),
        ({'status': 130}, 'crash'),
        ({'err': 'ros2cc-extract: internal error: KeyError'}, 'internal error'),
        ({'out': 'node.py:1:1: error CC500: cannot be followed: KeyError'}, 'internal error'),
        ({'left': ['child']}, 'leftover'),
        ({'seconds': 10.5}, 'too dear'),
        ({'megabytes': 1_001.0}, 'too dear'),
    ],
)
def test_how_a_command_has_ended(changes: dict[str, object], kind: str | None) -> None:
    found = judged({**ENDED, **changes})
    assert (found.kind if found else None) == kind


def test_what_an_attempt_leaves_is_seen(tmp_path: Path) -> None:
    def leave(name: str) -> Attempt:
        return Attempt(('--help',), lambda folder: (tmp_path / name).write_text('x') and None)

    with arena(tmp_path) as attacked:
        assert attacked.judge(Attempt(('--help',), nothing)) is None
        found = attacked.judge(leave('canary'))
        assert found == Found('canary', 'code of the input was run')
        found = attacked.judge(leave('temporary/x'))
        assert found == Found('leftover', "temporary ['x']")
        found = attacked.judge(Attempt(('env', '-o', 'made'), nothing))
        assert found == Found('leftover', "files ['made']")
        assert attacked.judge(Attempt(('env', '-o', 'made'), nothing, ('made',))) is None


def test_who_hangs_or_dies_is_begun_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with arena(tmp_path) as attacked:
        kill = Attempt(('run', '--', 'sh', '-c', 'kill -SEGV $PPID'), nothing)
        died = attacked.judge(kill)
        assert died is not None and (died.kind, 'status -11' in died.told) == ('crash', True)
        assert attacked.judge(Attempt(('--help',), nothing)) is None
        monkeypatch.setattr(watched, 'PATIENCE_S', 2)
        waits = Attempt(('verify', 'pipe'), lambda folder: os.mkfifo(folder / 'pipe'))
        hung = attacked.judge(waits)
        assert hung is not None and (hung.kind, 'status -6' in hung.told) == ('hang', True)
