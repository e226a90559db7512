"""What differs between releases of rclpy, as their sources say (``executors.py``)."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from ros2cc_extract.generator.build import Profile, render
from ros2cc_extract.generator.executor_kinds import TaskOrder, task_order
from ros2cc_extract.generator.releases import felt, model_setting
from ros2cc_extract.spec.releases.table import SPIN_REFUSED_TWICE
from tests.property.closed_specs import (
    random_entity_unit,
    random_locking_unit,
    random_spinning_unit,
    random_waking_unit,
)

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


RELEASES = ('3.3.21', '7.1.9', '9.1.2', '9.1.4', '10.0.10')
"""Releases with one order of tasks, and each setting of the other rows that a model may feel."""
MAKERS = (random_entity_unit, random_waking_unit, random_spinning_unit, random_locking_unit)


@pytest.mark.parametrize('number', range(40))
def test_releases_that_a_unit_does_not_tell_apart_have_one_model(number: int) -> None:
    random = Random(number)
    closed = MAKERS[number % len(MAKERS)](random, callbacks=4, groups=3, threads=2)
    rows = felt(closed.spec)
    models: dict[tuple[bool | None, ...], set[str]] = {}
    for release in RELEASES:
        of_release = replace(closed, spec=replace(closed.spec, rclpy=release))
        text = render(of_release, profile=Profile.RCLPY).xml
        models.setdefault(tuple(row.holds(release) for row in rows), set()).add(text)
    assert {len(texts) for texts in models.values()} == {1}


def test_units_that_feel_releases_are_among_them() -> None:
    units = [
        make(Random(n), callbacks=4, groups=3, threads=2) for n in range(10) for make in MAKERS
    ]
    assert {row.name for unit in units for row in felt(unit.spec)} >= {'spin-refused-twice'}


@pytest.mark.parametrize('number', range(20))
def test_units_of_one_setting_have_one_model(number: int) -> None:
    """``upgrade`` asks it once."""
    random = Random(number)
    closed = MAKERS[number % len(MAKERS)](random, callbacks=4, groups=3, threads=2)
    models: dict[object, set[str]] = {}
    for release in ('3.3.15', '7.1.6', *RELEASES):
        of_release = replace(closed, spec=replace(closed.spec, rclpy=release))
        text = render(of_release, profile=Profile.RCLPY).xml
        models.setdefault(model_setting(of_release.spec), set()).add(text)
    assert all(len(texts) == 1 for texts in models.values())
