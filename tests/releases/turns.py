"""
Which release is built today: each of those that are no wheel has its turn.

``ROS2CC_RELEASE=7.1.11`` names another.
"""

from __future__ import annotations

import os
from datetime import date
from pathlib import Path

import pytest

from tests.conformance.releases import RELEASES, VARIABLE, built, record_of
from tests.conformance.suite import Release

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / 'build' / 'releases'


def release_of_the_day() -> tuple[str, Release]:
    """Build it unless it is there; skip where nobody can."""
    of_today = RELEASES[date.today().toordinal() % len(RELEASES)]
    version = os.environ.get('ROS2CC_RELEASE', of_today)
    checkout = os.environ.get(VARIABLE)
    if checkout is None and not record_of(version, FOLDER).is_dir():
        pytest.skip(f'rclpy {version}: {VARIABLE} names no folder that builds it')
    return built(version, Path(checkout or ''), FOLDER)
