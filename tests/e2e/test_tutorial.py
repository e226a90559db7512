"""The tutorial, done: its files written, its changes applied, its commands run."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

from tests.e2e.conftest import ROOT
from tests.support.repositories import environment

PAGE = ROOT / 'docs' / 'tutorial.md'
BLOCK = re.compile(r'^```(\w+) ?(\S*)\n(.*?)^```$', re.MULTILINE | re.DOTALL)
ANYTHING = '…\n'


def test_every_step_does_what_the_page_shows(tmp_path: Path) -> None:
    shell(tmp_path, 'git init --quiet')
    (tmp_path / 'arm').mkdir()
    for kind, name, text in BLOCK.findall(PAGE.read_text(encoding='utf-8')):
        if kind == 'console':
            for command, shown in commands(text):
                assert_shown(shell(tmp_path, command), shown)
        elif kind == 'diff':
            (tmp_path / 'change').write_text(text)
            assert shell(tmp_path, 'git apply change && rm change') == ''
        else:
            (tmp_path / name).write_text(text)


def commands(text: str) -> Iterator[tuple[str, str]]:
    for part in re.split(r'^\$ ', text, flags=re.MULTILINE)[1:]:
        command, _, shown = part.partition('\n')
        yield command, shown


def shell(folder: Path, command: str) -> str:
    """What the command prints, as on a terminal."""
    return subprocess.run(
        ['bash', '-c', command],
        cwd=folder,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    ).stdout


def assert_shown(printed: str, shown: str) -> None:
    """A line with an ellipsis stands for any lines."""
    if ANYTHING in shown:
        pattern = '(?:.*\n)*'.join(map(re.escape, shown.split(ANYTHING)))
        assert re.fullmatch(pattern, printed), printed
    else:
        assert printed == shown
