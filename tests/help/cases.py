"""
The table of helps: each finding's help, carried out literally on a program that has the finding.

``*.yaml`` beside this file. A change is a diff without line numbers: what stands behind ``-`` and
blanks occurs once in the program, and what stands behind ``+`` and blanks replaces it.
"""

from __future__ import annotations

import ast
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import yaml

from ros2cc_extract.cli.main import main

HERE = Path(__file__).parent
TESTS = HERE.parent
HUNK = '@@'
# What a program says each time when it gets through.
THROUGH = 'goes on'


@dataclass(frozen=True, kw_only=True)
class Mended:
    """
    One way out of the several that a help may name, carried out.

    :param does: the words of the help, or of the page of the rule, that are carried out.
    :param diff: what they ask for.
    :param left: codes of what is still found: what is wrong yet, and advice on the set-up.
    :param says: what must be said among it, where the way out does not lead out by itself.
    :param shows: lines that come in this order; where there are none, that it gets through twice.
    :param is_run: not where it would end by what this machine or this release does not have.
    """

    does: tuple[str, ...]
    diff: str
    left: tuple[str, ...] = ()
    says: str = ''
    shows: tuple[str, ...] = ()
    is_run: bool = True


@dataclass(frozen=True, kw_only=True)
class Case:
    """
    A program with a finding.

    :param bad: its file, below ``tests``.
    :param at: text that stands there once; it is found in the line where that ends.
    :param says: the whole message.
    :param help: the whole help.
    :param shows: lines that come in this order when the fault shows; where there are none, it
        shows by not getting through.
    :param through: what it says when it gets through.
    :param aside: words of the help and of the page that are no way out of this program.
    :param is_run: not where the fault shows by chance or on other releases only.
    """

    code: str
    bad: str
    at: str
    says: str
    help: str
    mended: tuple[Mended, ...]
    shows: tuple[str, ...] = ()
    aside: tuple[str, ...] = ()
    through: str = THROUGH
    is_run: bool = True

    @property
    def name(self) -> str:
        return f'{self.code}_{Path(self.bad).stem}'

    @property
    def text(self) -> str:
        return (TESTS / self.bad).read_text(encoding='utf-8')

    @property
    def line(self) -> int:
        before, *behind = self.text.split(self.at)
        assert len(behind) == 1, f'{self.at!r} stands {len(behind)} times in {self.bad}'
        return f'{before}{self.at}'.count('\n') + 1

    def mended_text(self, mended: Mended) -> str:
        return apply(mended.diff, self.text)


@cache
def cases() -> tuple[Case, ...]:
    """All of them, in the order of their codes."""
    found = [
        _case(entry)
        for path in sorted(HERE.glob('*.yaml'))
        for entry in yaml.safe_load(path.read_text(encoding='utf-8'))
    ]
    return tuple(sorted(found, key=lambda case: case.code))


def _case(entry: Mapping[str, Any]) -> Case:
    mended = tuple(Mended(**_frozen(each)) for each in entry['mended'])
    return Case(**{**_frozen(entry), 'mended': mended})


def _frozen(entry: Mapping[str, Any]) -> dict[str, Any]:
    words = {**entry, 'does': entry['does']} if 'does' in entry else dict(entry)
    if isinstance(words.get('does'), str):
        words['does'] = [words['does']]
    return {
        key: tuple(value) if isinstance(value, list) else value for key, value in words.items()
    }


def apply(diff: str, text: str) -> str:
    """Change a text."""
    for hunk in diff.split(f'{HUNK}\n')[1:]:
        lines = [line or ' ' for line in hunk.splitlines()]
        assert all(line[0] in ' -+' for line in lines), hunk
        old = ''.join(f'{line[1:]}\n' for line in lines if line[0] != '+')
        new = ''.join(f'{line[1:]}\n' for line in lines if line[0] != '-')
        assert f'\n{text}'.count(f'\n{old}') == 1, f'stands there not once:\n{old}'
        text = f'\n{text}'.replace(f'\n{old}', f'\n{new}')[1:]
    return text


@dataclass(frozen=True)
class Said:
    """A finding, as far as a reader sees it."""

    code: str
    line: int
    message: str
    help: str


@cache
def said(text: str) -> tuple[Said, ...]:
    """What a check says of a program that lies not among tests, where less is said."""
    out, err = StringIO(), StringIO()
    with TemporaryDirectory() as folder:
        node = Path(folder) / 'node.py'
        node.write_text(text, encoding='utf-8')
        main(['check', '--no-cache', '--output-format', 'json', str(node)], out, err)
        shown = out.getvalue().replace(f'{folder}/', '')
    found = json.loads(shown)['findings']
    return tuple(Said(f['code'], f['line'], f['message'], f['help']) for f in found)


def asking(case: Case) -> str:
    """The program, which says ``asks`` right before it does what is found."""
    lines = case.text.splitlines(keepends=True)
    statements = [each for each in ast.walk(ast.parse(case.text)) if isinstance(each, ast.stmt)]
    around = [s for s in statements if s.lineno <= case.line <= (s.end_lineno or s.lineno)]
    inner = max(around, key=lambda statement: statement.lineno)
    lines.insert(inner.lineno - 1, f'{" " * inner.col_offset}print("asks", flush=True)\n')
    return ''.join(lines)
