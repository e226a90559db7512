"""The Mermaid chart of a unit."""

from __future__ import annotations

from ros2cc_extract.places import Unknown
from ros2cc_extract.report.unit_mermaid import unit_diagram
from ros2cc_extract.spec.model import (
    Blocking,
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)

SPEC = Spec(
    name='arm',
    callbacks=(
        Callback(
            name='drive',
            type=CallbackType.TMR,
            group='g',
            entity=EntityKind.TIMER,
            period_s=0.5,
            blocking=(Blocking(call='client.call', on='end'), Blocking(call='time.sleep')),
        ),
        Callback(
            name='end',
            type=CallbackType.CLT,
            group='free',
            entity=EntityKind.CLIENT,
            key=Unknown('a parameter'),
        ),
        Callback(name='hidden', type=CallbackType.SRV, group='g', builtin=True),
    ),
    groups=(
        CallbackGroup(name='g', type=GroupType.EXCLUSIVE),
        CallbackGroup(name='free', type=GroupType.REENTRANT),
        CallbackGroup(name='empty', type=GroupType.REENTRANT),
    ),
    executor=Executor(name='executor', kind='MultiThreadedExecutor', threads=('a', 'b')),
)


def test_groups_are_boxes_and_waits_are_arrows() -> None:
    assert (
        unit_diagram(SPEC)
        == """\
flowchart LR
    executor(["MultiThreadedExecutor, 2 threads"])
    subgraph n_g["g: mutually exclusive"]
        n_drive["drive<br/>timer every 0.5 s"]
    end
    executor --> n_g
    subgraph n_free["free: reentrant"]
        n_end["end<br/>client ?"]
    end
    executor --> n_free
    n_drive -. "client.call" .-> n_end
    style n_free stroke-dasharray: 5 5
"""
    )


def test_builtin_entities_are_drawn_when_asked_for() -> None:
    assert 'n_hidden["hidden<br/>SRV"]' in unit_diagram(SPEC, builtin=True)
