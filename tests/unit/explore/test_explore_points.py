"""Where threads may be held, as the scanner names it."""

from __future__ import annotations

from pathlib import Path

from ros2cc_extract.explore.first_look import units_of
from ros2cc_extract.explore.points import Point, points_of

TESTS = Path(__file__).parents[2]


def points(name: str) -> list[tuple[int, str, str, bool]]:
    found: tuple[Point, ...] = points_of(units_of([TESTS / name]))
    return [(each.line, each.kind, each.name, each.rests) for each in found]


def test_both_locks_of_each_callback_are_waits() -> None:
    assert points('bugs/g4_lock_order.py') == [
        (24, 'wait', 'plan_lock', False),
        (24, 'wait', 'motor_lock', False),
        (28, 'wait', 'motor_lock', False),
        (32, 'wait', 'plan_lock', False),
    ]


def test_of_shared_attributes_it_is_known_what_rests_on_a_read() -> None:
    """``report`` reads and then resets; what ``on_part`` adds in between is lost."""
    assert points('bugs/g2_lost_update.py') == [
        (25, 'access', 'Counter.count', True),
        (24, 'access', 'Counter.count', False),
        (21, 'access', 'Counter.count', True),
    ]


def test_what_one_callback_has_for_itself_is_no_point() -> None:
    own = [name for _, _, name, _ in points('explore/nodes/rare_lock_order.py')]
    assert 'Arm.plan' in own
    assert points('bugs/b10_call_in_own_group.py') == [(24, 'wait', 'map_ready_client', False)]


def test_a_file_that_cannot_be_read_has_none(tmp_path: Path) -> None:
    broken = tmp_path / 'broken.py'
    broken.write_text('def (', encoding='utf-8')
    assert points_of(units_of([broken, tmp_path / 'gone.py'])) == ()
