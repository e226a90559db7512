"""How places of creation are worded."""

from __future__ import annotations

import pytest
from finding_units import at, client, exclusive, outside, timer

from ros2cc_extract.findings.base.wording import made_at
from ros2cc_extract.spec.model import Callback, CallbackGroup, EntityKind


@pytest.mark.parametrize(
    ('owner', 'words'),
    [
        (timer('drive', source=at(9)), 'timer of drive is created here'),
        (client('plan_client', source=at(9)), "client 'plan' is created here"),
        (outside('task', EntityKind.TASK, source=at(9)), 'task is created here'),
        (exclusive('arm', source=at(9)), "group 'arm' is created here"),
        (exclusive('arm', source=at(9), default=True), 'the default group is created here'),
        (
            exclusive('arm_default', source=at(9), default=True, node='arm'),
            "the default group of 'arm' is created here",
        ),
    ],
)
def test_made_at(owner: Callback | CallbackGroup, words: str) -> None:
    assert [(remark.place, remark.text) for remark in made_at(owner)] == [(at(9), words)]
