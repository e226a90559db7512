"""Findings under several releases become one list."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.by_release import of_all_releases
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.releases.settings import settings
from ros2cc_extract.spec.releases.table import SPIN_REFUSED_TWICE

ROWS = (SPIN_REFUSED_TWICE,)
OLD, NEW = settings(ROWS)
ONE = Finding(
    code='CC109', severity=Severity.ERROR, place=Place('arm.py', 7, 9), message='one', unit='arm'
)
OTHER = replace(ONE, message='other')


def test_two_that_differ_in_words_alone_stay_two() -> None:
    (first,) = settings(())
    assert of_all_releases([(first, [ONE, OTHER])], ()) == (ONE, OTHER)
    assert of_all_releases([(OLD, [ONE, OTHER]), (NEW, [ONE, OTHER])], ROWS) == (ONE, OTHER)


def test_what_some_releases_have_names_them() -> None:
    found = of_all_releases([(OLD, [ONE]), (NEW, [])], ROWS)
    assert [each.message for each in found] == [
        'one (on Humble, Jazzy before 7.1.9, Kilted before 9.1.5)'
    ]
    (new,) = of_all_releases([(OLD, []), (NEW, [ONE])], ROWS)
    assert new.message == ('one (on Jazzy from 7.1.9 on, Kilted from 9.1.5 on, Lyrical, Rolling)')
