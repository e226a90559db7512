"""What differs between releases of rclpy, as their sources say (``executors.py``)."""

from __future__ import annotations

import pytest

from ros2cc_extract.generator.executor_kinds import TaskOrder, task_order
from ros2cc_extract.spec.releases.table import SPIN_REFUSED_TWICE

NEWEST, OLDEST = TaskOrder.NEWEST_FIRST, TaskOrder.OLDEST_FIRST


@pytest.mark.parametrize(
    ('rclpy', 'order'),
    [
        ('3.3.20', NEWEST),
        ('3.3.21', OLDEST),
        ('4.1.7', NEWEST),
        ('7.1.8', NEWEST),
        ('7.1.9', OLDEST),
        ('8.0.0', OLDEST),
        ('9.1.2', OLDEST),
        ('11.0.0', OLDEST),
        ('jazzy', None),
        (None, None),
    ],
)
def test_which_task_is_served_first(rclpy: str | None, order: TaskOrder | None) -> None:
    assert task_order(rclpy) is order


@pytest.mark.parametrize(
    ('rclpy', 'refuses'),
    [('3.3.21', False), ('7.1.9', True), ('9.1.4', False), ('9.1.5', True), ('10.0.1', True)],
)
def test_which_release_refuses_to_be_spun_twice(rclpy: str, refuses: bool) -> None:
    assert SPIN_REFUSED_TWICE.holds(rclpy) is refuses
