"""What holds for the whole suite: the same examples everywhere, patience with real rclpy."""

from __future__ import annotations

import signal

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


def pytest_configure() -> None:
    """
    Signals as on a terminal: what we start is asked to end by them, and must not ignore them.

    A shell without job control ignores SIGINT for what it starts in the background, ``nohup``
    ignores SIGHUP, and both are inherited.
    """
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if item.get_closest_marker('live'):
            # Real processes and real middleware: one lost race is theirs, three are ours.
            item.add_marker(pytest.mark.flaky(reruns=2))
