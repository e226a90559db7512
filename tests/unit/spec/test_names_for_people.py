"""How callbacks are called in sentences."""

from __future__ import annotations

from typing import Any

import pytest

from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.display_names import display_names
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)

CREATED = Place('arm.py', 20, 9)
DEFINED = Place('arm.py', 31, 5)
IN_PACKAGE = Place('src/robot/arm.py', 31, 5)


@pytest.mark.parametrize(
    ('facts', 'name'),
    [
        ({'function': 'arm.Arm.on_goal'}, 'on_goal'),
        ({'function': 'arm.Arm.on_goal', 'defined': DEFINED}, 'Arm.on_goal'),
        ({'function': 'robot.arm.Arm.Inner.on_goal', 'defined': IN_PACKAGE}, 'Arm.Inner.on_goal'),
        ({'function': 'robot.arm.on_goal', 'defined': IN_PACKAGE}, 'on_goal'),
        (
            {'function': 'robot.Arm.on_goal', 'defined': Place('robot/__init__.py', 3, 1)},
            'Arm.on_goal',
        ),
        ({'function': '__main__.Arm.on_goal', 'defined': DEFINED}, 'Arm.on_goal'),
        ({'function': 'arm.Arm.run.<locals>.on_goal', 'defined': DEFINED}, 'on_goal'),
        ({'function': None}, 'given'),
        ({'function': None, 'key': '/plan'}, 'given'),
        ({'function': None, 'key': '/plan', 'entity': EntityKind.CLIENT}, "client '/plan'"),
        (
            {'function': None, 'key': '/go', 'entity': EntityKind.ACTION_CLIENT},
            "action client '/go'",
        ),
        ({'function': None, 'key': Unknown('parameter'), 'entity': EntityKind.CLIENT}, 'given'),
        ({'function': 'arm.main.<locals>.<lambda>', 'defined': DEFINED}, 'lambda at line 31'),
        ({'function': 'arm.main.<locals>.<lambda>', 'source': CREATED}, 'lambda at line 20'),
        ({'function': 'arm.main.<locals>.<lambda>'}, 'given'),
        ({'function': 'arm.Arm.on_goal', 'entity': EntityKind.ACTION_SERVER}, 'given'),
    ],
)
def test_display_name(facts: dict[str, Any], name: str) -> None:
    callback = Callback(name='given', type=CallbackType.SUB, group='g', **facts)
    assert callback.display_name == name


def test_namesakes_are_told_apart() -> None:
    def client(name: str, line: int) -> Callback:
        place = Place('arm.py', line, 9)
        facts = {'entity': EntityKind.CLIENT, 'key': 'plan', 'source': place}
        return Callback(name=name, type=CallbackType.CLT, group='plans', **facts)  # type: ignore[arg-type]

    default = CallbackGroup(name='arm_default', type=GroupType.EXCLUSIVE, default=True, node='arm')
    callbacks = (client('a', 7), client('b', 9), client('c', 9))
    spec = Spec(
        name='arm',
        callbacks=(*callbacks, Callback(name='plan', type=CallbackType.SUB, group='arm_default')),
        groups=(CallbackGroup(name='plans', type=GroupType.EXCLUSIVE), default),
        executor=Executor(name='executor', threads=('thread_0',)),
    )
    assert display_names(spec) == {
        'a': "client 'plan' (line 7)",
        'b': "client 'plan' (b)",
        'c': "client 'plan' (c)",
        'plan': 'plan',
        'plans': "group 'plans'",
        'arm_default': "the default group of 'arm'",
    }
