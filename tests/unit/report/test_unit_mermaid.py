"""The Mermaid chart of a unit."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.report.unit_mermaid import sides_diagram, units_diagram
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
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
            blocking=(
                Blocking(call='client.call', on='end'),
                Blocking(call='time.sleep'),
                Blocking(call='client.call', on='end'),
                Blocking(call='Event.wait', on='drive'),
            ),
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
        units_diagram([SPEC])
        == """\
flowchart LR
    n_executor(["MultiThreadedExecutor, 2 threads"])
    subgraph n_g["g: mutually exclusive"]
        n_drive["drive<br/>timer every 0.5 s"]
    end
    n_executor --> n_g
    subgraph n_free["free: reentrant"]
        n_end["end<br/>client ?"]
    end
    n_executor --> n_free
    n_drive -. "client.call" .-> n_end
    style n_free stroke-dasharray: 5 5
"""
    )


def test_builtin_entities_are_drawn_when_asked_for() -> None:
    assert 'n_hidden["hidden<br/>SRV"]' in units_diagram([SPEC], builtin=True)


def test_several_units_are_one_chart_of_boxes() -> None:
    chart = units_diagram([SPEC, replace(SPEC, name='leg', callbacks=SPEC.callbacks[1:2])])
    assert chart.count('flowchart') == 1
    assert chart.endswith(
        """\
    subgraph side_1["unit leg"]
        s1u0_executor(["MultiThreadedExecutor, 2 threads"])
        subgraph s1u0_free["free: reentrant"]
            s1u0_end["end<br/>client ?"]
        end
        s1u0_executor --> s1u0_free
    end
    style s0u0_free stroke-dasharray: 5 5
    style s1u0_free stroke-dasharray: 5 5
"""
    )


def test_what_changed_is_marked_on_both_sides() -> None:
    after = replace(SPEC, callbacks=SPEC.callbacks[:1])
    chart = sides_diagram([('before', [SPEC]), ('after', [after])], {'end', 'free', 'executor'})
    assert '        s0u0_end["end<br/>client ?"]\n' not in chart.partition('"after"')[2]
    assert [line.strip() for line in chart.splitlines()[-5:]] == [
        'side_0 ~~~ side_1',
        'style s0u0_executor stroke:#c62828,stroke-width:3px',
        'style s0u0_free stroke:#c62828,stroke-width:3px,stroke-dasharray: 5 5',
        'style s0u0_end stroke:#c62828,stroke-width:3px',
        'style s1u0_executor stroke:#c62828,stroke-width:3px',
    ]
