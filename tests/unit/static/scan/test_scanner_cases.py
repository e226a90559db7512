"""Every file of ``tests/scanner_cases`` is scanned and compared whole with its expectation."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan

sys.path.insert(0, str(Path(__file__).parent))

from scanner_rendering import rendered

CASES = Path(__file__).parents[3] / 'scanner_cases'
MARK = '\n# expect:\n'


def case_paths() -> list[Path]:
    """Cases of one file, and the folders of those with several."""
    files = sorted(CASES.glob('*.py'))
    return [*files, *sorted(path for path in CASES.iterdir() if (path / 'expect.txt').is_file())]


def expectation(path: Path) -> str:
    if path.is_dir():
        return (path / 'expect.txt').read_text(encoding='utf-8').rstrip('\n')
    text = path.read_text(encoding='utf-8')
    lines = text.partition(MARK)[2].rstrip('\n').split('\n')
    return '\n'.join(line.removeprefix('# ') for line in lines)


@pytest.mark.parametrize('path', case_paths(), ids=lambda path: path.stem)
def test_scanner_case(path: Path) -> None:
    assert rendered(scan([path], root=CASES)) == expectation(path)


def test_every_row_of_the_pattern_table_has_a_case() -> None:
    missing = [f'P{row}' for row in range(1, 63) if f'P{row}' not in _mentioned()]
    assert missing == []


def test_each_thing_that_must_never_be_wrong_silently_has_a_case() -> None:
    missing = [f'Point {point}' for point in range(1, 24) if f'Point {point}' not in _mentioned()]
    assert missing == []


def _mentioned() -> set[str]:
    """What the first lines of the cases say that they show."""
    heads = [path.read_text(encoding='utf-8').split('\n', 1)[0] for path in CASES.glob('*.py')]
    words = [found for head in heads for found in re.findall(r'P\d+\b|[Pp]oint \d+\b', head)]
    return {word.capitalize() for word in words}
