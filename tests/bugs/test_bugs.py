"""One small node per known bug with what is found in it, and its mended twin."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.generator.build import Profile, Text
from ros2cc_extract.spec.assumptions import Assumptions, assume
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

HERE = Path(__file__).parent
COMPACT = Options(profile=Profile.RCLPY, text=Text.COMPACT)
MARK = '\n# finds: '
RELEASE = '^# rclpy: (.*)$'
CASES = sorted(path for path in HERE.glob('*.py') if not path.name.startswith('test_'))
BUGS = [path for path in CASES if not path.stem.endswith('_mended')]


# Reported bugs that a node's source, or a model of it, can show. A10 needs a running process, the
# reports of group I are of rclpy's own executors.
NUMBERS = {
    'a': (1, 2, 4, 5, 7, 9, 11, 12, 13, 14),
    'b': (1, 3, 4, 5, 6, 8, 10, 12),
    'c': (1, 3, 4, 6, 8),
    'd': (1, 2, 4, 5, 6),
    'e': (1, 3),
    'f': (1, 2),
    'g': (1, 2, 4),
    'h': (1, 2),
}
REPORTED = [f'{group}{number}' for group, numbers in NUMBERS.items() for number in numbers]


@cache
def findings_in(path: Path) -> tuple[Finding, ...]:
    """All findings, with the verdicts of the model as the check has them."""
    text = path.read_text(encoding='utf-8')
    extraction = scan_text(text, path.name)
    release = re.search(RELEASE, text, re.MULTILINE)
    tied = Assumptions(rclpy=release[1] if release else None)
    units = [assume(unit, tied) for unit in extraction.units if unit.callbacks]
    verifications = [verify_unit(close(unit), COMPACT) for unit in units]
    return findings_of(units, extraction.diagnostics, verifications)


def words(findings: tuple[Finding, ...]) -> str:
    return ', '.join(map(_short, findings)) or 'nothing'


def _short(finding: Finding) -> str:
    weight = '' if finding.severity is Severity.ERROR else f' {finding.severity.value}'
    return f'{finding.code}:{finding.place.line}{weight}'


@pytest.mark.parametrize('path', CASES, ids=lambda path: path.stem)
def test_findings_are_those_of_the_last_line(path: Path) -> None:
    expected = path.read_text(encoding='utf-8').rpartition(MARK)[2].strip()
    assert words(findings_in(path)) == expected


HANGS = [path for path in BUGS if re.search('CC10[1-59]', path.read_text(encoding='utf-8'))]


@pytest.mark.parametrize('path', HANGS, ids=lambda path: path.stem)
def test_the_model_shows_how_it_comes_to_hang(path: Path) -> None:
    errors = [f for f in findings_in(path) if f.severity is Severity.ERROR]
    hangs = [f for f in errors if re.fullmatch('CC10[1-59]', f.code)]
    shown = [finding for finding in hangs if finding.run is not None and finding.run.moments]
    assert shown == hangs


@pytest.mark.parametrize('path', BUGS, ids=lambda path: path.stem)
def test_nothing_is_left_to_mend_in_the_twin(path: Path) -> None:
    twin = path.with_name(f'{path.stem}_mended.py')
    assert [f for f in findings_in(twin) if f.severity is not Severity.NOTE] == []
    mended = {finding.code for finding in findings_in(path)} - {'CC501'}
    assert not mended & {finding.code for finding in findings_in(twin)}


@pytest.mark.parametrize('bug', REPORTED)
def test_every_reported_bug_has_a_node(bug: str) -> None:
    assert [path.stem for path in BUGS if path.stem.startswith(f'{bug}_')] != []
