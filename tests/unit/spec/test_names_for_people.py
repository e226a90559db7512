"""How callbacks are called in sentences."""

from __future__ import annotations

from typing import Any

import pytest

from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Callback, CallbackType, EntityKind

CREATED = Place('arm.py', 20, 9)
DEFINED = Place('arm.py', 31, 5)


@pytest.mark.parametrize(
    ('facts', 'name'),
    [
        ({'function': 'arm.Arm.on_goal'}, 'on_goal'),
        ({'function': None}, 'given'),
        ({'function': 'arm.main.<locals>.<lambda>', 'defined': DEFINED}, 'lambda at line 31'),
        ({'function': 'arm.main.<locals>.<lambda>', 'source': CREATED}, 'lambda at line 20'),
        ({'function': 'arm.main.<locals>.<lambda>'}, 'given'),
        ({'function': 'arm.Arm.on_goal', 'entity': EntityKind.ACTION_SERVER}, 'given'),
    ],
)
def test_display_name(facts: dict[str, Any], name: str) -> None:
    callback = Callback(name='given', type=CallbackType.SUB, group='g', **facts)
    assert callback.display_name == name
