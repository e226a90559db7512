"""Every example gives the specification and the verdicts that stand beside it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.e2e.expected import (
    EXAMPLES,
    SPEC_FILE,
    VERDICT_FILE,
    scan_example,
    spec_text,
    verdict_text,
)


@pytest.fixture(params=EXAMPLES, ids=lambda folder: folder.name)
def example(request: pytest.FixtureRequest) -> Path:
    folder: Path = request.param
    return folder


def test_specification_is_the_expected_one(example: Path) -> None:
    expected = (example / SPEC_FILE).read_text(encoding='utf-8')
    assert spec_text(scan_example(example)) == expected


def test_verdicts_are_the_expected_ones(example: Path) -> None:
    expected = (example / VERDICT_FILE).read_text(encoding='utf-8')
    assert verdict_text(scan_example(example)) == expected
