"""What the tool says of a node, and how that compares with what its row asks for."""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from functools import cache
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

from ros2cc_extract.cli.main import main
from tests.shapes.rows import BREAKS, WAITS, Node, Row, marked_lines

# What says no more than what a set-up is good for, or what an older release does.
ADVICE = ('CC118', 'CC401', 'CC402', 'CC403', 'CC404', 'CC5', 'CC6')
RACES = 'CC3'
# Notes on waits: nobody knows who ends it, or only another program can.
OPEN = {'CC120': 'undecided', 'CC121': 'assumed to end'}


@dataclass(frozen=True)
class Told:
    """
    What a check says of one node, each with the line where it says so.

    :param findings: codes of what it found, advice on the set-up left out.
    :param open_waits: in which way waits were left open.
    """

    findings: tuple[tuple[str, int], ...]
    open_waits: tuple[tuple[str, int], ...]


@cache
def told(path: Path) -> Told:
    """
    The check of one node, as a user runs it.

    It lies not among tests there, of which less is said.
    """
    out, err = StringIO(), StringIO()
    with TemporaryDirectory() as folder:
        node = shutil.copy(path, folder)
        main(['check', '--no-cache', '--output-format', 'json', node], out, err)
    said = [(found['code'], found['line']) for found in json.loads(out.getvalue())['findings']]
    return Told(
        findings=tuple(f for f in said if f[0] not in OPEN and not f[0].startswith(ADVICE)),
        open_waits=tuple((OPEN[code], line) for code, line in said if code in OPEN),
    )


def verdict(node: Node) -> str:
    """
    In one word what the tool says.

    Of a bad node: the codes at a marked line, else how a wait there was left open, else *silent*.
    Of a good node: the codes of all that it found, else how a wait was left open, else *clean*.
    """
    said = told(node.path)
    findings, open_waits = said.findings, said.open_waits
    if node.word == 'bad':
        marked = {line for lines in marked_lines(node.path, WAITS, BREAKS) for line in lines}
        findings = tuple(found for found in findings if found[1] in marked)
        open_waits = tuple(wait for wait in open_waits if wait[1] in marked)
    words = {word for word, _ in findings or open_waits}
    return ', '.join(sorted(words)) or ('silent' if node.word == 'bad' else 'clean')


def is_right(node: Node, said: str) -> bool:
    """Whether that is what was observed, or says honestly that it is open."""
    words = set(said.split(', '))
    if node.word == 'good':
        return said == 'clean' or words <= set(OPEN.values())
    return OPEN['CC120'] in words or _is_asked_for(node.row, words)


def _is_asked_for(row: Row, said: set[str]) -> bool:
    """One of its codes; ``finding`` asks for any that is no race, ``undecided`` for less."""
    asked = {word.strip() for word in row.finds.split(',')}
    if 'undecided' in asked and OPEN['CC121'] in said:
        return True
    codes = {word for word in said if word.startswith('CC')}
    any_wait = {code for code in codes if not code.startswith(RACES)}
    return bool(any_wait if 'finding' in asked else asked & codes)
