"""Which supported releases are alike in some behaviours, and how they are named."""

from __future__ import annotations

import pytest

from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.settings import settings, where
from ros2cc_extract.spec.releases.table import (
    FUTURE_YIELDS_ITSELF,
    NODE_STAYS,
    RCLPY,
    SPIN_REFUSED_TWICE,
)


@pytest.mark.parametrize(
    ('rows', 'expected'),
    [
        ((), ['Humble, Jazzy, Kilted, Lyrical, Rolling']),
        ((NODE_STAYS,), ['Humble, Jazzy, Kilted, Lyrical, Rolling']),
        (
            (SPIN_REFUSED_TWICE,),
            [
                'Humble, Jazzy before 7.1.9, Kilted before 9.1.5',
                'Jazzy from 7.1.9 on, Kilted from 9.1.5 on, Lyrical, Rolling',
            ],
        ),
        (
            (SPIN_REFUSED_TWICE, FUTURE_YIELDS_ITSELF),
            [
                'Humble before 3.3.21, Jazzy before 7.1.9, Kilted before 9.1.4',
                'Humble from 3.3.21 on, Kilted from 9.1.4 and before 9.1.5',
                'Jazzy from 7.1.9 on, Kilted from 9.1.5 on, Lyrical, Rolling',
            ],
        ),
    ],
)
def test_settings_by_their_releases(rows: tuple[Behaviour, ...], expected: list[str]) -> None:
    assert [where(setting.releases, rows) for setting in settings(rows)] == expected


def test_all_of_some_settings_are_named_together() -> None:
    rows = (SPIN_REFUSED_TWICE, FUTURE_YIELDS_ITSELF)
    releases = [release for setting in settings(rows)[:2] for release in setting.releases]
    assert where(releases, rows) == 'Humble, Jazzy before 7.1.9, Kilted before 9.1.5'


@pytest.mark.parametrize('row', RCLPY, ids=lambda row: row.name)
def test_one_release_stands_for_all_of_its_setting(row: Behaviour) -> None:
    for setting in settings((row,)):
        if setting.releases:
            assert (row.holds(setting.release),) == setting.values
    assert settings((row,))[0].values == (row.holds(None) is True,)
