"""
The compact text of a profile gives the verdicts of its plain text: shown unit by unit.

The same on thousands of units: ``make texts``.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from compared_texts import (
    Case,
    Comparison,
    Effort,
    compare,
    compare_series,
    digest,
    paper_case,
    rclpy_case,
    read_record,
    sum_up,
)

from ros2cc_extract.generator import build

SMALL = Effort(states=8_000)
#: A unit of profile rclpy whose texts differ if only one callback may get data.
OVERLAPPING = 1_019
NUMBERS = range(1_000, 1_004)


@pytest.mark.parametrize('draw', [paper_case, rclpy_case])
def test_texts_agree_on_small_units(draw: Callable[[int], Case]) -> None:
    decided, number = 0, 0
    while decided < 25:
        found = compare(number, draw(number), SMALL)
        assert not found.differing, f'unit {number}: {found.differing}'
        decided += not found.open
        number += 1


def test_texts_that_differ_are_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    case = rclpy_case(OVERLAPPING)
    assert not compare(OVERLAPPING, case, SMALL).differing
    monkeypatch.setattr(build, 'CALLBACKS_IN_PLAY', 1)
    found = compare(OVERLAPPING, case, SMALL)
    assert ('not satisfied', 'satisfied') in found.differing.values()
    assert f'units that differ: {{{OVERLAPPING}: ' in sum_up('rclpy', [found])


def test_what_limits_leave_open_is_no_agreement() -> None:
    found = compare(OVERLAPPING, rclpy_case(OVERLAPPING), Effort(states=5))
    assert found.open
    assert not found.differing
    told = sum_up('rclpy', [found])
    assert f'0 decided in full (0 with reductions), 1 not [{OVERLAPPING}]; ' in told


def test_a_series_goes_on_where_it_was_cut(tmp_path: Path) -> None:
    record = tmp_path / 'record.jsonl'
    whole = compare_series('rclpy', NUMBERS, SMALL, record, float('inf'))
    lines = record.read_text().strip().splitlines()
    record.write_text('\n'.join([*lines[:2], lines[2][:-5]]))
    assert compare_series('rclpy', NUMBERS, SMALL, record, seconds=-1) == whole[:2]
    again = compare_series('rclpy', NUMBERS, SMALL, record, float('inf'))
    assert sorted(again, key=lambda each: each.number) == whole
    assert list(read_record(record).values()) == whole


def test_a_record_of_other_texts_counts_for_nothing(tmp_path: Path) -> None:
    record = tmp_path / 'record.jsonl'
    compare_series('rclpy', NUMBERS, SMALL, record, float('inf'))
    record.write_text(record.read_text().replace(digest(rclpy_case(1_002)), 'of another'))
    kept = compare_series('rclpy', NUMBERS, SMALL, record, seconds=-1)
    assert [each.number for each in kept] == [1_000, 1_001, 1_003]


def test_only_what_was_left_open_is_tried_again_with_more_states(tmp_path: Path) -> None:
    record = tmp_path / 'record.jsonl'
    numbers = range(OVERLAPPING - 3, OVERLAPPING + 1)
    few, more = Effort(states=50), Effort(states=100)
    found = compare_series('rclpy', numbers, few, record, float('inf'))
    is_open = {each.number: bool(each.open) for each in found}
    assert set(is_open.values()) == {True, False}
    kept = {each.number for each in compare_series('rclpy', numbers, more, record, seconds=-1)}
    assert kept == {number for number in numbers if not is_open[number]}
    fewer = compare_series('rclpy', numbers, Effort(states=40), record, seconds=-1)
    assert fewer == found


def test_what_came_of_a_series_is_told() -> None:
    found = [
        Comparison(1, 'a', 9, queries=8),
        Comparison(2, 'b', 9, queries=10, is_reduced=True),
        Comparison(3, 'c', 9, queries=7, is_reduced=True, open=['A[] p', 'E<> q']),
    ]
    assert sum_up('rclpy', found) == (
        'profile rclpy, plain and compact text of 3 units: 2 decided in full (1 with reductions), '
        '1 not [3]; 23 of 25 verdicts compared, units that differ: none'
    )
