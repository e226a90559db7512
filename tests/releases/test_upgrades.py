"""
What `upgrade` lists for whole nodes is what was observed to change, at its line.

A line ``# differs: ROW`` of a node says that the next one behaves otherwise on releases that have
another setting of this row of the table.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from io import StringIO
from itertools import pairwise
from pathlib import Path

import pytest

from ros2cc_extract.cli.commands import upgrade
from ros2cc_extract.cli.main import main
from ros2cc_extract.spec.releases.table import ROWS
from tests.releases.observe import WHEELS
from tests.releases.observe_upgrades import NODES, read_observed, watched

OBSERVED = read_observed()
RELEASES = ('3.3.21', '7.1.6', '7.1.11', '9.1.2', '9.1.5', '10.0.10', '11.0.0')
FIRST = [('3.3.21', '7.1.6'), ('7.1.6', '7.1.11'), ('7.1.6', '9.1.2')]
PAIRS = [*FIRST, *pairwise(RELEASES[2:]), ('3.3.21', '10.0.10'), ('9.1.5', '7.1.11')]
BY_NAME = {row.name: row for row in ROWS}
MARK = re.compile(r'# differs: (.+)')
LISTED_ONCE = 'spin-yields'
#: What is decided is within a tenth of it, and one unit is not in a minute; the long suite waits.
BRIEF_S = 2.0

Line = tuple[int, str]
each_node = pytest.mark.parametrize('node', NODES, ids=lambda node: node.stem)


def marks(node: Path) -> Iterator[Line]:
    """Lines of a node that behave otherwise, each with the row that decides it."""
    for number, line in enumerate(node.read_text().splitlines(), start=1):
        found = MARK.search(line)
        yield from ((number + 1, name) for name in (found[1].split(', ') if found else ()))


def differing(node: Path, old: str, new: str) -> set[Line]:
    return {(line, name) for line, name in marks(node) if BY_NAME[name].differs(old, new)}


def upgraded(node: Path, old: str, new: str) -> dict[Line, str]:
    """The lines that ``upgrade`` lists, each with its row, and what it says of them."""
    out = StringIO()
    main(['upgrade', '--from', old, '--to', new, str(node)], out, StringIO())
    listed: dict[Line, str] = {}
    said, line = '', 0
    for text in out.getvalue().splitlines():
        place = re.match(rf'\S*{node.name}:(\d+):\d+: (.*)', text)
        because = re.match(r' +because of ([\w-]+): ', text)
        if place:
            line, said = int(place[1]), place[2]
        elif because:
            listed[line, because[1]] = said
    return listed


@each_node
def test_marks_are_what_was_observed(node: Path) -> None:
    """Two releases show the same of a node unless a marked line differs."""
    seen = OBSERVED[node.stem]
    for old, new in PAIRS:
        assert (seen[old] != seen[new]) == bool(differing(node, old, new)), (old, new)


@each_node
@pytest.mark.parametrize(
    'pairs', [FIRST, pytest.param(PAIRS[len(FIRST) :], marks=pytest.mark.slow)], ids=['', 'all']
)
def test_upgrade_lists_what_differs_and_nothing_else(
    node: Path, pairs: list[tuple[str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    if pairs is FIRST:
        monkeypatch.setattr(upgrade, 'SECONDS', BRIEF_S)
    for old, new in pairs:
        listed = upgraded(node, old, new)
        certain = {
            line for line, said in listed.items() if ', if ' not in said and line[1] != LISTED_ONCE
        }
        expected = differing(node, old, new)
        assert {line for line, _ in expected} <= {line for line, _ in listed}, (old, new)
        assert certain <= expected, (old, new)


@pytest.mark.live
@pytest.mark.slow
@pytest.mark.parametrize('version', WHEELS)
@each_node
def test_a_node_on_a_wheel_does_what_was_observed(node: Path, version: str) -> None:
    assert watched(WHEELS[version], node, None) == OBSERVED[node.stem][version]
