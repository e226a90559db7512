"""What two systems have differently, and which differences prove nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest

from ros2cc_extract.compare.merge import Difference, Kind
from ros2cc_extract.compare.system_merge import merge_systems
from ros2cc_extract.compare.systems import diff_systems
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.node_graph import Endpoint, EndpointKind, Qos
from ros2cc_extract.spec.system.launched import RECORDED, RUNNING, Launched
from ros2cc_extract.spec.system.model import Process, System, SystemEndpoint, SystemNode
from ros2cc_extract.spec.system.names import Remap

PUB, SUB = EndpointKind.PUBLISHER, EndpointKind.SUBSCRIPTION
RELIABLE = Qos(reliability='reliable', durability='volatile', liveliness='automatic')
STRING, BOOL = 'std_msgs/msg/String', 'std_msgs/msg/Bool'
LAUNCHED = Launched(kind='node', source=Place('a.launch.xml', 2, 3))
OPEN = Unknown('a part is not followed', Place('arm.py', 9, 1))


def end(kind: EndpointKind, name: str | Unknown, line: int = 5, **facts: object) -> SystemEndpoint:
    of = Endpoint(
        kind=kind,
        name=name,
        type=str(facts.pop('type', STRING)),
        qos=facts.pop('qos', RELIABLE),  # type: ignore[arg-type]
        source=Place('arm.py', line, 9),
    )
    found = SystemEndpoint(
        kind=kind, name=name, written=of.name, type=of.type, source=of.source, of=of
    )
    return replace(found, **facts)  # type: ignore[arg-type]


def node(name: str | Unknown, *ends: SystemEndpoint, **facts: object) -> SystemNode:
    own = name.rpartition('/')[2] if isinstance(name, str) else 'arm'
    found = SystemNode(name=name, own_name=own, endpoints=ends, source=Place('arm.py', 3, 9))
    return replace(found, **facts)  # type: ignore[arg-type]


def system(*nodes: SystemNode, **facts: object) -> System:
    """Each node in a process of its own."""
    processes = (
        Process(name=f'p{number}', launched=LAUNCHED, nodes=(each,))
        for number, each in enumerate(nodes)
    )
    return System(name='s', processes=tuple(replace(p, **facts) for p in processes))  # type: ignore[arg-type]


def told(left: System, right: System) -> list[str]:
    return [line_of(each) for each in diff_systems(left, right)]


def line_of(each: Difference) -> str:
    mark = '~' if each.marked else ''
    return f'{mark}{each.unit} | {each.subject} | {each.fact} | {each.left} | {each.right}'


ARM = node('/arm', end(SUB, '/goal'), end(PUB, '/state', 6, type=BOOL))


def test_the_same_twice_has_no_difference() -> None:
    assert diff_systems(system(ARM), system(ARM)) == ()


@pytest.mark.parametrize(
    ('ends', 'lines'),
    [
        ([end(SUB, '/target')], ['/arm | subscription /goal | name | /goal | /target']),
        (
            [end(SUB, '/goal', type=BOOL)],
            [f'/arm | subscription /goal | type | {STRING} | {BOOL}'],
        ),
        (
            [end(SUB, '/goal', qos=replace(RELIABLE, reliability='best_effort', deadline_s=0.5))],
            [
                '/arm | subscription /goal | reliability | reliable | best_effort',
                '/arm | subscription /goal | deadline_s | none | 0.5 s',
            ],
        ),
        ([], [f'/arm | subscription /goal | topic | {STRING} | ']),
        (
            [end(SUB, '/goal'), end(SUB, '/stop', 8)],
            [f'/arm | subscription /stop | topic |  | {STRING}'],
        ),
        ([end(SUB, '/goal', qos=None)], []),
        ([end(SUB, '/goal', qos=replace(RELIABLE, reliability=None))], []),
        ([end(SUB, OPEN)], ['~/arm | subscription /goal | name | /goal | not known']),
    ],
)
def test_endpoints_are_compared(ends: Sequence[SystemEndpoint], lines: list[str]) -> None:
    left = system(node('/arm', end(SUB, '/goal')))
    assert told(left, system(node('/arm', *ends))) == lines


def test_a_name_is_told_at_the_rule_that_has_renamed_it() -> None:
    rule = Remap(old='goal', new='target', source=Place('a.launch.xml', 4, 7))
    left = system(node('/arm', end(SUB, '/target', remap=rule, written='goal')))
    (found,) = diff_systems(left, system(node('/arm', end(SUB, '/goal', 11))))
    assert found == Difference(
        kind=Kind.DIFFERS,
        unit='/arm',
        subject='subscription /target',
        fact='name',
        left='/target',
        right='/goal',
        left_place=Place('a.launch.xml', 4, 7),
        right_place=Place('arm.py', 11, 9),
    )


@pytest.mark.parametrize(
    ('left', 'right', 'lines'),
    [
        (ARM, replace(ARM, name='/left/arm'), ['/arm | /arm | name | /arm | /left/arm']),
        (ARM, replace(ARM, name='/arm_2', own_name='b'), ['/arm | /arm | name | /arm | /arm_2']),
        (replace(ARM, name=OPEN), ARM, ['~arm | arm | name | not known | /arm']),
        (
            ARM,
            node('/leg'),
            ['/arm | /arm | node | process p0 | ', '/leg | /leg | node |  | process p0'],
        ),
        (
            replace(ARM, open=OPEN),
            replace(ARM, endpoints=(*ARM.endpoints, end(SUB, '/stop', 8))),
            [f'~/arm | subscription /stop | topic |  | {STRING}'],
        ),
    ],
)
def test_nodes_are_compared(left: SystemNode, right: SystemNode, lines: list[str]) -> None:
    assert told(system(left), system(right)) == lines


def lidar(**facts: object) -> Process:
    launched = replace(LAUNCHED, **facts)  # type: ignore[arg-type]
    return Process(name='lidar', launched=launched, outside=Unknown('it is no Python'))


def test_a_node_that_is_no_python_is_known_by_its_name_in_the_launch_file() -> None:
    left = System(name='s', processes=(lidar(name='lidar', namespace='/front'),))
    right = system(node('/front/lidar', end(PUB, '/scan')), outside=Unknown('by the graph'))
    assert told(left, right) == [f'~/front/lidar | publisher /scan | topic |  | {STRING}']


def test_where_a_process_may_hold_any_node_a_further_one_proves_nothing() -> None:
    left = System(name='s', processes=(lidar(),))
    assert told(left, system(ARM)) == [
        '~/arm | /arm | node |  | process p0',
        '~lidar | lidar | process | outside: it is no Python | ',
    ]


def test_what_is_no_python_is_missing_from_recordings_and_not_from_the_graph() -> None:
    left = System(name='s', processes=(lidar(name='lidar'),))
    recorded = system(ARM, launched=replace(LAUNCHED, kind=RECORDED))
    running = system(ARM, launched=replace(LAUNCHED, kind=RUNNING))
    lines = ['/lidar | /lidar | node | process lidar | ', '/arm | /arm | node |  | process p0']
    assert told(left, recorded) == [f'~{lines[0]}', lines[1]]
    assert told(left, running) == lines


def test_what_is_started_under_a_condition_may_be_missing() -> None:
    left = system(ARM, launched=replace(LAUNCHED, conditional=OPEN))
    assert told(left, System(name='s', processes=())) == ['~/arm | /arm | node | process p0 | ']


def test_a_join_takes_what_is_not_known_from_the_other() -> None:
    left = system(node(OPEN, end(SUB, OPEN, qos=None), own_name='arm'))
    right = system(replace(ARM, name='/left/arm'), node('/leg'))
    whole = merge_systems(left, right)
    assert [process.name for process in whole.processes] == ['p0', 'p1']
    (arm,) = whole.processes[0].nodes
    assert arm.name == '/left/arm'
    assert [(each.kind, each.name, each.of.qos) for each in arm.endpoints] == [
        (SUB, '/goal', RELIABLE),
        (PUB, '/state', RELIABLE),
    ]
    assert diff_systems(whole, right) == ()
