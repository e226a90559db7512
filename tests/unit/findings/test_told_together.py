"""What is mended at one line, or in one callback, is one finding, however many come there."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import ONE_THREAD, at, calls, service, subscription, threads, timer, unit

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import NOT_FOLLOWED, UNKNOWN_WAIT, Access, Blocking
from ros2cc_extract.spec.model import Callback, Spec

Accesses = dict[str, tuple[Access, ...]]


def read_then_written(name: str, line: int, **facts: bool) -> Accesses:
    read, write = (Access(name=name, source=at(line + more)) for more in (0, 1))
    return {'reads': (read,), 'writes': (replace(write, rests=True, **facts),)}


def findings(spec: Spec, code: str) -> list[Finding]:
    return [each for each in findings_of([spec], [], [None]) if each.code.startswith(code)]


def races(*callbacks: Callback) -> list[Finding]:
    return findings(unit(threads(3), *callbacks), 'CC3')


def test_two_attributes_of_one_callback() -> None:
    goal, state = read_then_written('Arm.goal', 30), read_then_written('Arm.state', 20)
    both = {kind: (*goal[kind], *state[kind]) for kind in ('reads', 'writes')}
    (finding,) = races(service('on_go', 'free', **both))
    assert finding.place == at(21)
    assert finding.message == (
        'on_go may overlap itself when messages come together, and writes Arm.state, Arm.goal '
        'because of what it has read of them before, without one lock around both: that may no '
        'longer hold'
    )
    assert finding.subjects == ('on_go', 'Arm.state', 'Arm.goal')
    first = finding.related[0]
    assert (first.place, first.text) == (at(31), 'on_go writes Arm.goal here')


CLEARED: Accesses = {
    'reads': (
        Access(name='Arm.goal', source=at(20)),
        Access(name='Arm.goal', source=at(21), rests=True, later=True),
    ),
    'writes': (Access(name='Arm.goal', source=at(22), rests=True, clears=True),),
}


def test_two_callbacks_that_clear_an_object_at_one_line() -> None:
    use, write = races(service('on_go', 'free', **CLEARED), service('on_stop', 'free', **CLEARED))
    assert (use.code, use.message) == (
        'CC305',
        'on_go tests Arm.goal and then uses it, and on_stop may set it to None in between: then '
        'the use raises an exception',
    ), 'what one does to itself there is mended with it'
    assert (write.code, write.message) == (
        'CC304',
        'on_go, on_stop may overlap themselves when messages come together, and write Arm.goal '
        'because of what they have read of it before, without one lock around both: that may no '
        'longer hold',
    )
    assert write.subjects == ('on_go', 'on_stop', 'Arm.goal')


def test_two_callbacks_that_come_together_by_different_things() -> None:
    tick = timer('tick', 'free', period_s=0.1, **CLEARED)
    _, write = races(service('on_go', 'free', **CLEARED), tick)
    assert write.message.startswith('on_go, tick may overlap themselves, and write Arm.goal')


def test_what_weighs_more_stands_alone() -> None:
    goal, state = read_then_written('Arm.goal', 20), read_then_written('Arm.state', 40)
    both = {kind: (*goal[kind], *state[kind]) for kind in ('reads', 'writes')}
    both['reads'] = (
        Access(name='Arm.goal', source=at(20)),
        Access(name='Arm.state', source=at(5)),
    )
    pause = Blocking(call='time.sleep', seconds=0.2, source=at(30))
    found = races(service('on_go', 'free', blocking=(pause,), **both))
    assert [(each.place, each.severity) for each in found] == [
        (at(41), Severity.WARNING),
        (at(21), Severity.NOTE),
    ]


def test_a_spin_at_one_line() -> None:
    (wait,) = calls('other', call='rclpy.spin_until_future_complete')
    spun = replace(ONE_THREAD, kind='SingleThreadedExecutor', spun='rclpy.spin')
    callbacks = [subscription(name, blocking=(wait,)) for name in ('on_go', 'on_stop')]
    (finding,) = findings(unit(spun, *callbacks), 'CC107')
    assert finding.message.startswith(
        'on_go, on_stop call rclpy.spin_until_future_complete on the executor that runs them: '
    )
    assert finding.subjects == ('on_go', 'on_stop', 'executor')


def test_a_transform_at_one_line() -> None:
    listener = subscription('tf', key='/tf')
    (wait,) = calls('tf', call='Buffer.lookup_transform', seconds=1.0)
    callbacks = [service(name, blocking=(wait,)) for name in ('on_go', 'on_stop')]
    (finding,) = findings(unit(ONE_THREAD, *callbacks, listener), 'CC205')
    assert finding.message.startswith('on_go, on_stop wait in Buffer.lookup_transform on the only')
    assert finding.subjects == ('on_go', 'on_stop', 'tf')


def not_followed(line: int, why: str = 'too late') -> tuple[Blocking, ...]:
    place = at(line)
    unknown = Unknown(why, place)
    return (Blocking(call=NOT_FOLLOWED, source=place, on=unknown, escapes=unknown),)


def test_all_that_was_not_followed_for_one_reason() -> None:
    late = [timer(f'tick_{line}', blocking=not_followed(line)) for line in (10, 20)]
    long = timer('work', blocking=not_followed(30, 'too long'))
    found = findings(unit(threads(2), *late, long), 'CC120')
    assert [(each.place, each.message) for each in found] == [
        (
            at(10),
            'not decided: tick_10, tick_20 may wait in code that is not followed: too late',
        ),
        (at(30), 'not decided: work may wait in code that is not followed: too long'),
    ]


@pytest.mark.parametrize(
    ('reason', 'told'),
    [
        (
            'link.wait_ready: a library that is not scanned',
            'tick waits in link.wait_ready, and it is not known what ends it: a library that is '
            'not scanned',
        ),
        (
            'a library that is not scanned',
            'tick waits in unknown wait, and it is not known what ends it: a library that is not '
            'scanned',
        ),
    ],
)
def test_an_unknown_wait_is_called_by_its_call(reason: str, told: str) -> None:
    wait = Blocking(call=UNKNOWN_WAIT, source=at(10), escapes=Unknown(reason))
    (finding,) = findings(unit(threads(2), timer('tick', blocking=(wait,))), 'CC120')
    assert finding.message == f'not decided: {told}'


def slept(*callbacks: Callback) -> list[str]:
    return [each.message for each in findings(unit(ONE_THREAD, *callbacks), 'CC201')]


def test_two_services_of_one_function_that_sleeps() -> None:
    sleep = (Blocking(call='time.sleep', source=at(20), seconds=2.0),)
    both = [
        replace(service(name, blocking=sleep), function='node.on_list')
        for name in ('list', 'list_too')
    ]
    other = service('on_go')
    begin = 'on_list sleeps 2 s and holds the only thread of the SingleThreadedExecutor: '
    end = ' and the parameter services of the node wait that long'
    assert slept(*both, other) == [f'{begin}on_go{end}']
    assert slept(*both) == [f'{begin}on_list{end}']


def test_objects_of_one_class_that_lose_at_one_line() -> None:
    """Each has the same way to lose it, in this unit or another; the class is mended once."""
    rows = [read_then_written(f'Filter#{number}.value', 30) for number in (2, 3, 4)]
    units = [
        unit(threads(3), service('on_a', 'free', **row), service('on_b', 'free', **row))
        for row in rows
    ]
    found = [each for each in findings_of(units, [], [None] * 3) if each.code == 'CC301']
    assert [each.place for each in found] == [at(31)]
    assert 'Filter#2.value' in found[0].message
    assert found[0].message.endswith('; the same of 2 more objects')
