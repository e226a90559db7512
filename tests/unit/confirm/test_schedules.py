"""Which order a finding is shown by, and which statements a place stands for."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from ros2cc_extract.confirm.schedules import (
    Point,
    Schedule,
    can_be_tried,
    read_schedule,
    schedule_of,
    write_schedule,
)
from ros2cc_extract.confirm.statements import lines_of, loop_future, values_compared
from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.generator.build import Profile, Text
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

EXAMPLES = Path(__file__).parents[3] / 'launch_free_examples'
BUGS = Path(__file__).parents[2] / 'bugs'
OPTIONS = Options(profile=Profile.RCLPY, text=Text.COMPACT)
SOURCE = """\
def wait(self, future):
    while not future.done():
        time.sleep(0.1)
    with self.lock:
        if mode == 'off' and level > 3:
            self.call(
                1,
            )
"""


def schedules(stem: str) -> list[Schedule]:
    return schedules_of(BUGS / f'{stem}.py')


def schedules_of(path: Path) -> list[Schedule]:
    extraction = scan_text(path.read_text(encoding='utf-8'), str(path))
    units = [unit for unit in extraction.units if unit.callbacks]
    verifications = [verify_unit(close(unit), OPTIONS) for unit in units]
    found = findings_of(units, extraction.diagnostics, verifications)
    return [schedule_of(each, units) for each in found if can_be_tried(each)]


def test_two_locks_are_waited_for_at_two_places_that_hold() -> None:
    (schedule,) = schedules('g4_lock_order')
    file = str(BUGS / 'g4_lock_order.py')
    assert (schedule.code, schedule.line, schedule.forever) == ('CC111', 24, True)
    assert (schedule.entry, schedule.function) == (file, 'main')
    assert schedule.points == (
        Point(file=file, first=24, last=24, column=30, holds=True),
        Point(file=file, first=32, last=32, column=14, holds=True),
    )
    assert schedule.held == ()


def test_what_sets_the_event_is_held_until_it_is_waited_for() -> None:
    (schedule,) = schedules('b14_event_set_by_own_group')
    file = str(BUGS / 'b14_event_set_by_own_group.py')
    assert schedule.points == (Point(file=file, first=24, last=24),)
    assert [(each.function, each.file, each.soft) for each in schedule.held] == [
        ('on_closed', file, False)
    ]
    assert not schedule.forever, 'it says: unless the event is already set'


def test_the_answer_is_held_until_all_threads_wait_for_it() -> None:
    (schedule,) = schedules_of(EXAMPLES / 'pool_exhaustion' / 'node.py')
    assert [point.first for point in schedule.points] == [52, 57]
    held = {(each.kind or each.function, each.key, each.soft) for each in schedule.held}
    assert held == {('on_plan', '', True), ('client', 'plan', False)}


def test_what_has_no_part_in_the_run_is_held_softly() -> None:
    (schedule,) = schedules('a5_spin_once_in_service')
    assert [(each.function, each.soft) for each in schedule.held] == [('on_closed', True)]
    assert schedule.leaves


@pytest.mark.parametrize(
    'stem', ['g4_lock_order', 'b14_event_set_by_own_group', 'd2_asyncio_sleep']
)
def test_a_schedule_is_read_as_it_was_written(stem: str, tmp_path: Path) -> None:
    (schedule,) = schedules(stem)
    file = tmp_path / 'kept.json'
    file.write_text(write_schedule(schedule), encoding='utf-8')
    assert read_schedule(file) == schedule


@pytest.mark.parametrize(
    'text', ['', '[]', '{}', '{"ros2cc_confirm": 2}', '{"ros2cc_confirm": 1, "points": [1]}']
)
def test_what_is_no_schedule_is_refused(text: str, tmp_path: Path) -> None:
    file = tmp_path / 'kept.json'
    file.write_text(text, encoding='utf-8')
    with pytest.raises(InputError, match='is no schedule that confirm has written'):
        read_schedule(file)


@pytest.mark.parametrize(
    ('line', 'lines'),
    [(1, (1, 1)), (2, (2, 3)), (3, (3, 3)), (4, (4, 4)), (7, (6, 8)), (99, (99, 99))],
)
def test_a_place_stands_for_its_statement(line: int, lines: tuple[int, int]) -> None:
    assert lines_of(ast.parse(SOURCE), line) == lines


def test_a_loop_names_the_future_that_it_asks_for() -> None:
    assert loop_future(ast.parse(SOURCE), 3) == 'future'
    assert loop_future(ast.parse(SOURCE), 6) is None


def test_messages_may_hold_what_a_program_compares_with() -> None:
    assert values_compared(ast.parse(SOURCE)) == ['off', 3, 4]
