"""What must agree before a release, and what is found when it does not."""

from __future__ import annotations

from pathlib import Path

import pytest
from packaging.requirements import Requirement

from release import audit, check
from release.dependencies import lowest, requirements
from release.targets import SYSTEMS, VERSIONS, System
from release.trial import wheel_of

WHEEL = 'ros2cc_extract-0.1.0-cp310-cp310-musllinux_1_2_aarch64.whl'


def test_what_says_versions_and_dependencies_agrees() -> None:
    assert [*check.versions(), *check.dependencies()] == []


def test_another_version_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check, '__version__', '9.9')
    assert list(check.versions()) == [
        'package.xml says 0.1.0, and version.py 9.9',
        'release/robostack/recipe.yaml says 0.1.0, and version.py 9.9',
    ]
    told = ['the newest section of CHANGELOG.md is not "## 9.9"']
    assert list(check.changelog()) == told


@pytest.mark.parametrize(
    ('heading', 'unreleased', 'is_accepted'),
    [
        ('## 9.9', False, True),
        ('## [9.9] - 2026-11-23', True, True),
        ('## 9.9.1', True, False),
        ('## Unreleased', True, True),
        ('## Unreleased', False, False),
    ],
)
def test_the_newest_section_of_the_changelog_is_this_version(
    heading: str,
    unreleased: bool,
    is_accepted: bool,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    monkeypatch.setattr(check, '__version__', '9.9')
    monkeypatch.setattr(check, 'ROOT', tmp_path)
    (tmp_path / 'CHANGELOG.md').write_text(f'# Changelog\n\n{heading}\n\n## 9.9\n')
    assert (not list(check.changelog(unreleased=unreleased))) == is_accepted


def test_wheels_that_are_not_there_are_told(tmp_path: Path) -> None:
    assert len(list(check.absent(tmp_path))) == 1 + len(SYSTEMS)
    (tmp_path / WHEEL).touch()
    told = 'musllinux_1_2_aarch64: no wheel for CPython 3.11, 3.12, 3.13, 3.14'
    assert told in check.absent(tmp_path)
    assert VERSIONS == ('3.10', '3.11', '3.12', '3.13', '3.14')


def test_a_module_is_named_for_its_version_and_system_alone() -> None:
    names = [system.suffix(version) for system in SYSTEMS for version in VERSIONS]
    # CPython 3.10 has one name for both libraries.
    assert len(set(names)) == len(names) - 2
    assert System('aarch64', 'musl').suffix('3.11') == '.cpython-311-aarch64-linux-musl.so'


def test_the_name_of_a_wheel_says_what_it_is_for() -> None:
    wheel = wheel_of(Path(WHEEL))
    assert (wheel.version, wheel.machine, wheel.is_musl) == ('3.10', 'aarch64', True)
    assert wheel.tag == 'cp310-cp310-musllinux_1_2_aarch64'


def test_a_part_under_the_name_of_another_version_is_no_part() -> None:
    names = [
        'ros2cc_extract/checker/_core.pyi',
        'ros2cc_extract/checker/_core.cpython-310-x86_64-linux-gnu.so',
        'ros2cc_extract/extract/live/_journal.cpython-311-x86_64-linux-gnu.so',
        'ros2cc_extract/extract/live/_enter.cpython-310-x86_64-linux-gnu.so',
    ]
    found = [audit.suffixes(part, names) for part in audit.PARTS]
    assert found == [['cpython-310'], ['cpython-311'], ['cpython-310']]


def test_every_dependency_has_a_lowest_version() -> None:
    assert lowest(Requirement('tomli>=1.1; python_version < "3.11"')) == (
        'tomli==1.1; python_version < "3.11"'
    )
    assert all('==' in lowest(each) for each in requirements())
