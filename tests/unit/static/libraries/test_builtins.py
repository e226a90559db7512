"""What rclpy makes by itself is listed on demand only; the live tests compare it with rclpy."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from ros2cc_extract.extract.static.api import scan

PROGRAM = Path(__file__).parents[3] / 'live' / 'programs' / 'every_builtin.py'


def test_by_default_nothing_is_listed_that_nobody_wrote() -> None:
    (unit,) = scan([PROGRAM]).units
    assert [c.name for c in unit.callbacks if c.builtin] == []
    assert [group.name for group in unit.groups] == ['group', 'rate_group', 'arm_default']


def test_each_node_gets_what_its_options_ask_for() -> None:
    (unit,) = scan([PROGRAM], lists_builtin=True).units
    made = Counter((c.node, c.entity.value) for c in unit.callbacks if c.builtin and c.entity)
    assert made == {
        ('arm', 'parameter_service'): 6,
        ('arm', 'service'): 1,
        ('arm', 'qos_event'): 7,
        ('lamp', 'parameter_service'): 6,
        ('lamp', 'lifecycle_service'): 5,
        ('lamp', 'service'): 3,
        ('lamp', 'qos_event'): 4,
        ('clockwork', 'subscription'): 1,
        ('clockwork', 'service'): 1,
        ('clockwork', 'qos_event'): 4,
        ('door', 'lifecycle_service'): 5,
        ('door', 'service'): 1,
        ('door', 'qos_event'): 2,
    }
