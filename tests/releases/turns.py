"""Which release is built today: each of those that are no wheel has its turn."""

from __future__ import annotations

import os
from datetime import date
from pathlib import Path

import pytest

from tests.conformance.releases import RELEASES, VARIABLE, built
from tests.conformance.suite import Release

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / 'build' / 'releases'


def release_of_the_day() -> tuple[str, Release]:
    """Build it unless it is there; skip where nobody can."""
    version = RELEASES[date.today().toordinal() % len(RELEASES)]
    checkout = os.environ.get(VARIABLE)
    if checkout is None:
        pytest.skip(f'rclpy {version}: {VARIABLE} names no folder that builds it')
    return built(version, Path(checkout), FOLDER)
