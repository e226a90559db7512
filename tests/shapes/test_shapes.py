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
    assert is_right(node, said) or said == node.row.not_yet.get(node.word)


@pytest.mark.slow
def test_nothing_is_excused_that_the_tool_can_say() -> None:
    excused = [node for node in ALL if node.word in node.row.not_yet]
    assert [node.name for node in excused if is_right(node, verdict(node))] == []


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
