"""What the tool says of a node, and how that compares with what its row asks for."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from io import StringIO
from pathlib import Path

from ros2cc_extract.cli.main import main
from tests.shapes.rows import BREAKS, WAITS, Node, Row, marked_lines

# What says no more than what a set-up is good for.
ADVICE = ('CC401', 'CC402', 'CC403', 'CC404', 'CC5', 'CC6')
UNDECIDED = 'undecided'


@dataclass(frozen=True)
class Told:
    """
    What a check says of one node.

    :param findings: code and line of what it found, advice on the set-up left out.
    :param undecided: lines of the waits that it could not decide.
    """

    findings: tuple[tuple[str, int], ...]
    undecided: tuple[int, ...]


@cache
def told(path: Path) -> Told:
    """The check of one node, as a user runs it."""
    out, err = StringIO(), StringIO()
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, err)
    said = json.loads(out.getvalue())
    findings = [(finding['code'], finding['line']) for finding in said['findings']]
    return Told(
        findings=tuple(f for f in findings if not f[0].startswith(ADVICE)),
        undecided=tuple(sorted(map(_line, said['summary'].get('undecided_waits', ())))),
    )


def _line(wait: Mapping[str, object]) -> int:
    """The line of a wait: told as a number, or within its place."""
    if 'line' in wait:
        return int(str(wait['line']))
    return int(str(wait['place']).split(':')[1])


def verdict(node: Node) -> str:
    """
    In one word what the tool says.

    Of a bad node: the codes at a marked line, else *undecided* there, else *silent*. Of a good
    node: the codes of all that it found, else *undecided*, else *clean*.
    """
    said = told(node.path)
    if node.word == 'bad':
        marked = {line for lines in marked_lines(node.path, WAITS, BREAKS) for line in lines}
        codes = {code for code, line in said.findings if line in marked}
        undecided = marked & set(said.undecided)
    else:
        codes, undecided = {code for code, _ in said.findings}, set(said.undecided)
    if codes:
        return ', '.join(sorted(codes))
    if undecided:
        return UNDECIDED
    return 'silent' if node.word == 'bad' else 'clean'


def is_right(node: Node, said: str) -> bool:
    """Whether the row is content with that: what was observed, or honestly undecided."""
    if said == UNDECIDED:
        return True
    if node.word == 'good':
        return said == 'clean'
    return said != 'silent' and _is_asked_for(node.row, said)


def _is_asked_for(row: Row, said: str) -> bool:
    """Codes that the row names; ``finding`` is content with any."""
    asked = {word.strip() for word in row.finds.split(',')}
    return 'finding' in asked or bool(asked & set(said.split(', ')))
