"""What holds for the whole suite: the same examples everywhere, patience with real rclpy."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, settings

# How long an example takes is no verdict: machines are busy, and emulated processors slow.
settings.register_profile(
    'patient', deadline=None, suppress_health_check=[HealthCheck.too_slow], derandomize=True
)
PATIENT = settings.get_profile('patient')
# A change is judged by examples that are the same everywhere; `make test-long` draws new ones.
settings.register_profile('same', parent=PATIENT)
settings.register_profile('new', parent=PATIENT, derandomize=False)
settings.load_profile('same')


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if item.get_closest_marker('live'):
            # Real processes and real middleware: one lost race is theirs, three are ours.
            item.add_marker(pytest.mark.flaky(reruns=2))
