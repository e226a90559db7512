"""Changes reach each line of releases in a release of its own."""

from __future__ import annotations

import pytest

from ros2cc_extract.spec.releases import COROUTINES_IN_EVENTS, NODE_STAYS, has_change


@pytest.mark.parametrize(
    ('version', 'expected'),
    [
        ('7.1.10', False),
        ('7.1.11-1noble', True),
        ('9.1.1', False),
        ('9.1.2', True),
        ('10.0.0', False),
        ('11.0.0', True),
        ('3.3.15', False),
        ('8.0.0', None),
        ('jazzy', None),
        (None, None),
    ],
)
def test_release_with_coroutines_in_the_events_executor(
    version: str | None, expected: bool | None
) -> None:
    assert has_change(version, COROUTINES_IN_EVENTS) is expected


def test_line_after_the_latest_has_the_change() -> None:
    assert has_change('9.1.2', NODE_STAYS) is True
