"""
What the tool says of each shape of waiting and ending is what was observed, or *undecided*.

The whole table on real rclpy: ``make shapes``.
"""

from __future__ import annotations

import re

import pytest

from tests.shapes.observe import NOT_RUN
from tests.shapes.page import PAGE, page
from tests.shapes.rows import BREAKS, HERE, WAITS, Node, Row, marked_lines, nodes, rows
from tests.shapes.told import is_right, verdict

EVERY = 8
ALL = nodes()


def cases(nodes: tuple[Node, ...]) -> list[object]:
    """A sample of them; the others are slow in sum."""
    marks = [() if at // 2 % EVERY == 0 else (pytest.mark.slow,) for at in range(len(nodes))]
    return [pytest.param(n, id=n.name, marks=m) for n, m in zip(nodes, marks, strict=True)]


@pytest.mark.parametrize('node', cases(ALL))
def test_the_tool_says_what_was_observed(node: Node) -> None:
    said = verdict(node)
    expected_today = node.row.not_yet.get(node.word)
    if expected_today is None:
        assert is_right(node, said), f'{node.name}: {said}'
    else:
        assert said == expected_today, f'{node.name}: the table still excuses {expected_today!r}'
        assert not is_right(node, said), f'{node.name}: {said!r} needs no excuse any more'


def test_the_table_is_long_enough_and_in_order() -> None:
    shapes = [row.shape for row in rows()]
    assert len(shapes) >= 80
    assert shapes == sorted(set(shapes), key=lambda shape: int(re.findall(r'^s(\d+)_', shape)[0]))


def test_every_node_is_of_a_row_and_every_row_has_its_nodes() -> None:
    on_disk = {path.stem for path in HERE.glob('s[0-9]*_*.py')}
    assert on_disk == {node.name for node in ALL}


@pytest.mark.parametrize('row', rows(), ids=lambda row: row.shape)
def test_the_bad_node_is_marked_and_the_good_one_is_not(row: Row) -> None:
    bad, good = (node for node in ALL if node.row is row)
    assert marked_lines(bad.path, WAITS, BREAKS) != ()
    assert marked_lines(good.path, WAITS, BREAKS) == ()


@pytest.mark.parametrize('row', rows(), ids=lambda row: row.shape)
def test_a_bad_node_does_not_do_what_a_good_one_does(row: Row) -> None:
    """On one distribution at least."""
    assert NOT_RUN in row.bad.values() or dict(row.bad) != dict(row.good)


def test_the_page_is_that_of_the_table() -> None:
    assert PAGE.read_text(encoding='utf-8') == page()
