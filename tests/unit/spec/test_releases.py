"""Changes reach each line of releases in a release of its own."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

from ros2cc_extract import findings, generator
from ros2cc_extract.spec.releases import table
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.lines import LINES, judged_as
from ros2cc_extract.spec.releases.page import page
from ros2cc_extract.spec.releases.table import (
    COROUTINES_IN_EVENTS,
    EXCEPTION_AFTER_AWAIT_LOST,
    NODE_STAYS,
    RCLPY,
    ROWS,
    SHUTDOWN_WAITS_NOT,
    TASKS_OLDEST_FIRST,
)

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize(
    ('version', 'expected'),
    [
        ('7.1.10', False),
        ('7.1.11-1noble', True),
        ('9.1.1', False),
        ('9.1.2', True),
        ('10.0.0', False),
        ('11.0.0', True),
        ('3.3.15', False),
        ('8.0.0', None),
        ('jazzy', None),
        ('kilted', True),
        ('humble', False),
        ('foxy', None),
        (None, None),
    ],
)
def test_release_with_coroutines_in_the_events_executor(
    version: str | None, expected: bool | None
) -> None:
    assert COROUTINES_IN_EVENTS.holds(version) is expected


def test_line_after_the_latest_has_the_change() -> None:
    assert NODE_STAYS.holds('9.1.2') is True


def test_what_all_supported_releases_do_needs_no_release() -> None:
    assert NODE_STAYS.holds(None) is True
    assert SHUTDOWN_WAITS_NOT.holds(None) is None


@pytest.mark.parametrize(
    ('version', 'is_lost'),
    [
        ('3.3.20', False),
        ('3.3.21', True),
        ('3.3.22', False),
        ('7.1.6', False),
        ('7.1.11', True),
        ('9.1.5', True),
        ('10.0.9', True),
        ('10.0.10', False),
        ('11.0.0', False),
    ],
)
def test_behaviour_that_came_and_went(version: str, is_lost: bool) -> None:
    assert EXCEPTION_AFTER_AWAIT_LOST.holds(version) is is_lost


@pytest.mark.parametrize(
    ('version', 'told'),
    [
        ('7.1.11', None),
        ('7.1.12', 'rclpy 7.1.12 is judged as 7.1.11, the newest known'),
        ('12.3.0', 'rclpy 12.3.0 is judged as 11.0.1, the newest known'),
        (
            '4.1.7',
            'rclpy 4.1.7 is judged as a release of a line that is not supported; those are '
            'Humble 3, Jazzy 7, Kilted 9, Lyrical 10, Rolling 11',
        ),
        ('jazzy', None),
    ],
)
def test_release_newer_than_the_table_is_told(version: str, told: str | None) -> None:
    assert judged_as(version) == told


def test_what_differs_between_two_releases() -> None:
    assert TASKS_OLDEST_FIRST.differs('7.1.6', '9.1.2')
    assert not TASKS_OLDEST_FIRST.differs('7.1.9', '9.1.2')
    assert not TASKS_OLDEST_FIRST.differs('jazzy', 'kilted')


def test_what_is_told_of_a_release() -> None:
    assert TASKS_OLDEST_FIRST.words_for('7.1.6') == TASKS_OLDEST_FIRST.without
    assert TASKS_OLDEST_FIRST.words_for('7.1.9') == TASKS_OLDEST_FIRST.having
    assert TASKS_OLDEST_FIRST.words_for('jazzy') == (
        'the task that was made last is served first, or the task that was made first is '
        'served first'
    )


def test_every_row_says_what_it_rests_on() -> None:
    assert len({row.name for row in ROWS}) == len(ROWS)
    for row in ROWS:
        assert all((row.concerns, row.without, row.having, row.source, row.observed)), row.name


def test_nothing_changes_behind_the_newest_release_that_was_looked_at() -> None:
    newest = {line.major: line.newest for line in LINES}
    changes = [change for row in RCLPY for change in row.changes()]
    assert [each for each in changes if each > newest.get(each[0], each)] == []


def test_page_of_the_documentation_is_that_of_the_table() -> None:
    """Written anew by ``make rules``."""
    assert (ROOT / 'docs' / 'releases.md').read_text(encoding='utf-8') == page()


def test_every_row_is_read_by_a_model_a_rule_or_upgrade() -> None:
    """What only the page shows would be a claim on which nothing rests."""
    rows = {name for name, value in vars(table).items() if isinstance(value, Behaviour)}
    # Where they are imported from: of an installed package no sources lie beside its tests.
    files = [
        path for part in (generator, findings) for path in Path(part.__path__[0]).rglob('*.py')
    ]
    read = {name for path in files for name in uses(path)}
    assert rows - read == set()


def uses(path: Path) -> Iterator[str]:
    """Names that a module uses, not those that it only imports."""
    for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
        if isinstance(node, ast.Name):
            yield node.id
