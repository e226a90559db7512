"""CC2xx and CC4xx: what keeps others waiting, and settings that change nothing."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import (
    DEFAULT,
    EVENTS_EXECUTOR,
    FREE,
    NOT_FOUND,
    ONE_THREAD,
    OTHER,
    at,
    calls,
    client,
    default_threads,
    exclusive,
    found,
    only,
    outside,
    service,
    sleeps,
    subscription,
    threads,
    timer,
    unit,
)

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Act
from ros2cc_extract.spec.model import (
    NO_EXECUTOR,
    Callback,
    EntityKind,
    Executor,
    Unresolved,
    When,
)

LOST = Unresolved(subject='executor', fact='executor', reason='no known executor', source=at(9))
HOLE = Unresolved(subject='tick', fact='topic', reason='a parameter', source=at(3))


def test_a_long_sleep_in_the_default_group_stops_parameter_services() -> None:
    sleeper = subscription('on_dock', blocking=sleeps(5.0))
    spec = unit(threads(2), sleeper, timer('tick'), timer('free', 'other'))
    assert only(spec, 'CC201').message == (
        "on_dock sleeps 5 s and holds the default group of 'arm': tick and the parameter "
        'services of the node wait that long'
    )
    assert found(unit(threads(2), sleeper, timer('free', 'other'), timer('t')))[0][:5] == 'CC201'


def test_a_short_sleep_or_one_in_a_group_of_its_own_is_left_alone() -> None:
    spec = unit(threads(2), timer('a', blocking=sleeps(0.9)), timer('b', 'other'))
    assert found(spec) == []
    spec = unit(threads(2), timer('a', 'other', blocking=sleeps(5.0)), timer('b'))
    assert found(spec) == []


@pytest.mark.parametrize('executor', [ONE_THREAD, threads(2)])
def test_a_sleep_is_long_for_a_timer_that_misses_five_runs(executor: Executor) -> None:
    def told(seconds: float, *others: Callback) -> list[str]:
        spec = unit(executor, subscription('on_scan', blocking=sleeps(seconds)), *others)
        return [code for code in found(spec) if code.startswith('CC2')]

    often = replace(timer('b'), period_s=0.1, source=at(12))
    seldom = replace(timer('c'), period_s=0.5)
    assert told(0.9, often, seldom) == ['CC201:50 warning']
    assert told(0.9, seldom) == told(0.4, often) == []
    assert told(0.9, replace(often, one_shot=True)) == []
    spec = unit(executor, subscription('on_scan', blocking=sleeps(0.9)), often, seldom)
    assert only(spec, 'CC201').related[-1] == Remark(at(12), 'b is due every 0.1 s')


def test_short_sleeps_add_up_for_a_timer_that_misses_five_runs() -> None:
    naps = (*sleeps(0.4, 40), *sleeps(0.3, 50))
    often = replace(timer('b'), period_s=0.1)
    spec = unit(ONE_THREAD, subscription('on_scan', blocking=naps), often)
    assert only(spec, 'CC201').message == (
        'on_scan sleeps 0.4 s here, with 1 more place 0.7 s in all, and holds the only thread of '
        'the SingleThreadedExecutor: b and the parameter services of the node wait that long'
    )


def test_a_long_sleep_on_one_thread_stops_everything() -> None:
    spec = unit(ONE_THREAD, timer('a', 'other', blocking=sleeps(5.0)), timer('b'))
    assert 'the only thread of the SingleThreadedExecutor' in only(spec, 'CC201').message


def test_a_callback_with_many_sleeps_is_one_finding_at_the_longest() -> None:
    lines = reversed(range(50, 57))
    naps = sleeps(0.5, 40) + sleeps(3.0, 60) + sum((sleeps(2.0, line) for line in lines), ())
    spec = unit(ONE_THREAD, timer('a', blocking=naps), timer('b'))
    finding = only(spec, 'CC201')
    assert finding.place == at(60)
    assert finding.message == (
        'a sleeps 3 s here, 1 s or longer at 7 more places, and holds the only thread of the '
        'SingleThreadedExecutor: b and the parameter services of the node wait that long'
    )
    assert finding.related == tuple(Remark(at(n), 'a sleeps 2 s here') for n in range(50, 55))


def test_rounds_of_a_loop_and_short_sleeps_add_up() -> None:
    nap = sleeps(0.25, 40)[0]
    spec = unit(ONE_THREAD, timer('a', blocking=(replace(nap, times=5),)), timer('b'))
    assert only(spec, 'CC201').message.startswith(
        'a sleeps 0.25 s 5 times (1.25 s in all) and holds the only'
    )
    naps = (replace(nap, times=2), *sleeps(0.6, 50))
    finding = only(unit(ONE_THREAD, timer('a', blocking=naps), timer('b')), 'CC201')
    assert finding.place == at(50)
    assert finding.message.startswith('a sleeps 0.6 s here, with 1 more place 1.1 s in all, and')
    either = tuple(replace(nap, conditional=True) for nap in naps)
    assert found(unit(ONE_THREAD, timer('a', blocking=either), timer('b'))) == []


@pytest.mark.parametrize('call', ['Condition.wait', 'Event.wait', 'Queue.get', 'Thread.join'])
def test_a_wait_with_a_long_time_out_delays_like_a_sleep(call: str) -> None:
    def waiting(seconds: float, group: str = 'arm_default') -> list[str]:
        wait = calls(None, call=call, seconds=seconds)
        spec = unit(threads(2), timer('a', group, blocking=wait), timer('b'), timer('c', 'other'))
        return [code for code in found(spec) if code.startswith('CC2')]

    assert waiting(1.5) == ['CC201:40 warning']
    assert waiting(0.5) == []
    assert waiting(1.5, 'other') == []


@pytest.mark.parametrize('executor', [ONE_THREAD, threads(2)])
def test_a_wait_that_holds_up_only_what_rclpy_made_is_a_note(executor: Executor) -> None:
    wait = calls(None, call='Event.wait', seconds=1.5)
    alone = unit(executor, timer('a', blocking=wait))
    assert [code for code in found(alone) if code.startswith('CC2')] == ['CC201:40 note']
    nap = unit(executor, timer('a', blocking=sleeps(1.5)))
    assert [code for code in found(nap) if code.startswith('CC2')] == ['CC201:50 warning']


def test_message_of_a_wait_with_a_long_time_out() -> None:
    wait = calls(None, call='Condition.wait', seconds=1.5)
    spec = unit(ONE_THREAD, timer('a', blocking=wait), timer('b'))
    assert only(spec, 'CC201').message == (
        'a waits up to 1.5 s in Condition.wait and holds the only thread of the '
        'SingleThreadedExecutor: b and the parameter services of the node wait that long'
    )


NOWHERE = replace(NOT_FOUND, kind=Unknown(NO_EXECUTOR, at(9)))


def test_a_node_that_no_executor_serves_is_named() -> None:
    spec = replace(unit(NOWHERE, timer('a')), entry='arm.py:main', unresolved=(LOST,))
    finding = only(spec, 'CC407')
    assert found(spec) == ['CC407:9 warning']
    assert finding.message == 'no executor serves arm, and nothing spins it: a never runs'


@pytest.mark.parametrize(
    'facts',
    [
        {'entry': None},
        {'entry': 'test_arm.py:main'},
        {'entry': 'arm/test/arm.py:main'},
        {'entry': 'arm.py:main', 'unresolved': (replace(HOLE, fact='entities'),)},
        {'entry': 'arm.py:main', 'executor': NOT_FOUND},
    ],
)
def test_a_node_that_somebody_else_may_serve_is_no_finding(facts: dict[str, object]) -> None:
    spec = replace(unit(NOWHERE, timer('a')), **facts)  # type: ignore[arg-type]
    assert [code for code in found(spec) if code.startswith('CC4')] == []


def test_an_executor_that_was_not_found_is_told_by_the_name_of_the_node() -> None:
    spec = replace(unit(NOT_FOUND, timer('a')), unresolved=(LOST,))
    assert only(spec, 'CC501').message == 'executor of arm not resolved: no known executor'


def test_two_callers_of_one_sleep_are_two_findings() -> None:
    spec = unit(ONE_THREAD, timer('a', blocking=sleeps(2.0)), timer('b', blocking=sleeps(2.0)))
    assert found(spec) == ['CC201:50 warning', 'CC201:50 warning']


def test_a_class_under_an_executor_of_another_file_names_it() -> None:
    spun = replace(ONE_THREAD, source=Place('test_arm.py', 30, 5))
    execute = outside('execute', EntityKind.ACTION_EXECUTE, blocking=sleeps(5.0))
    for spec, code in (
        (unit(spun, timer('a', blocking=sleeps(5.0))), 'CC201'),
        (unit(spun, execute), 'CC203'),
    ):
        assert only(spec, code).related[-1] == Remark(
            Place('test_arm.py', 30, 5), 'the SingleThreadedExecutor of this run is here'
        )
    same = replace(ONE_THREAD, source=at(90))
    assert only(unit(same, execute), 'CC203').related == ()


def test_of_two_programs_the_one_in_the_file_of_the_class_is_told() -> None:
    spun = replace(ONE_THREAD, source=Place('a_test.py', 30, 5))
    other = replace(unit(spun, timer('a', blocking=sleeps(5.0))), name='a_test')
    own = unit(replace(ONE_THREAD, source=at(90)), timer('a', blocking=sleeps(5.0)))
    (finding,) = findings_of([own, other], [])
    assert finding.related == ()
    assert findings_of([other, own], []) == (finding,)


@pytest.mark.parametrize(
    ('seconds', 'is_long'), [(0.99, False), (1.0, True), (Unknown('a parameter'), False)]
)
def test_a_sleep_is_long_from_a_second_on(seconds: float | Unknown, is_long: bool) -> None:
    sleep = replace(sleeps(1.0)[0], seconds=seconds)
    spec = unit(ONE_THREAD, timer('a', blocking=(sleep,)), timer('b'))
    assert ('CC201:50 warning' in found(spec)) is is_long


def test_an_execute_callback_that_sleeps_hides_the_cancel_request() -> None:
    execute = outside('execute', EntityKind.ACTION_EXECUTE, blocking=sleeps(5.0) + sleeps(5.0, 60))
    assert found(unit(ONE_THREAD, execute)) == ['CC203:50 warning']
    assert [f for f in found(unit(threads(2), execute)) if f.startswith('CC2')] == []


def waits_for_service(executor: Executor, *others: Callback, **facts: object) -> list[str]:
    waits = calls('plan_client', call='wait_for_service', **facts)
    drive = timer('drive', blocking=waits)
    spec = unit(executor, drive, client('plan_client', 'free'), *others)
    return [f for f in found(spec) if f.startswith(('CC1', 'CC20'))]


def test_waiting_for_a_service_without_a_time_out_holds_the_only_thread() -> None:
    assert waits_for_service(ONE_THREAD) == ['CC204:40 warning']
    assert waits_for_service(EVENTS_EXECUTOR) == ['CC204:40 warning']
    assert waits_for_service(ONE_THREAD, seconds=1.0) == []
    assert waits_for_service(threads(2)) == []
    assert waits_for_service(NOT_FOUND) == []


def test_a_service_of_the_same_unit_is_there_already() -> None:
    assert waits_for_service(ONE_THREAD, service('on_plan', key='plan')) == []
    later = service('on_plan', key='plan', when=When.CALLBACK)
    assert waits_for_service(ONE_THREAD, later) == ['CC204:40 warning']


def test_message_of_waiting_for_a_service() -> None:
    waits = calls('plan_client', call='wait_for_service')
    spec = unit(ONE_THREAD, timer('drive', blocking=waits), client('plan_client'), timer('tick'))
    assert only(spec, 'CC204').message == (
        'drive waits in wait_for_service for as long as it takes, on the only thread of the '
        "SingleThreadedExecutor: until service 'plan' is there no other callback runs"
    )
    nameless = replace(client('plan_client'), key=Unknown('name from a parameter'))
    spec = unit(ONE_THREAD, timer('drive', blocking=waits), nameless, timer('tick'))
    assert only(spec, 'CC204').message.endswith(
        ': until the server is there no other callback runs'
    )


def test_callbacks_that_wait_at_one_line_for_the_same_service_are_one_finding() -> None:
    callers = [
        timer(name, blocking=calls('plan_client', call='wait_for_service', chain=(at(line),)))
        for name, line in (('drive', 20), ('turn', 25))
    ]
    home = timer('go_home', blocking=calls('home_client', call='wait_for_service'))
    clients = client('plan_client'), client('home_client')
    spec = unit(ONE_THREAD, *callers, home, *clients)
    messages = [f.message for f in findings_of([spec], [], [None]) if f.code == 'CC204']
    assert [message.partition(' in ')[0] for message in messages] == [
        'drive, turn wait',
        'go_home waits',
    ]


@pytest.mark.parametrize(
    ('seconds', 'severity', 'end'),
    [
        (2.0, Severity.WARNING, 'everything waits 2 s for nothing'),
        (0.1, Severity.WARNING, 'everything waits 0.1 s for nothing'),
        (0.003, Severity.NOTE, 'everything waits 0.003 s for nothing'),
        (None, Severity.WARNING, 'everything waits'),
    ],
)
def test_a_short_wait_for_a_transform_is_a_note(
    seconds: float | None, severity: Severity, end: str
) -> None:
    look = calls('on_tf', call='Buffer.lookup_transform', seconds=seconds)
    listener = subscription('on_tf', key='/tf')
    finding = only(unit(ONE_THREAD, timer('look', blocking=look), listener), 'CC205')
    assert (finding.severity, finding.message.rpartition(', and ')[2]) == (severity, end)


@pytest.mark.parametrize(
    ('kind', 'call', 'question'),
    [
        (EntityKind.CLIENT, 'wait_for_service', 'service_is_ready'),
        (EntityKind.ACTION_CLIENT, 'wait_for_server', 'server_is_ready'),
    ],
)
def test_what_may_be_asked_instead_of_waiting(kind: EntityKind, call: str, question: str) -> None:
    asked = replace(client('plan_client'), entity=kind)
    spec = unit(ONE_THREAD, timer('drive', blocking=calls('plan_client', call=call)), asked)
    assert only(spec, 'CC204').help == (
        f'wait before the node is spun, or ask {question} and come back by a timer'
    )


def test_an_overloaded_group_starves_who_is_served_later() -> None:
    def codes(period: float, *callbacks: object) -> list[str]:
        busy = timer('camera', period_s=period, blocking=sleeps(0.2))
        others = (subscription('on_stop'), timer('free', 'other'))
        return [f for f in found(unit(threads(2), *others, busy)) if f.startswith('CC2')]

    assert codes(0.1) == ['CC202:50 warning']
    assert codes(0.2) == ['CC202:50 warning']
    assert codes(0.25) == []


def test_who_takes_longer_than_its_period_keeps_others_waiting() -> None:
    slow = timer('slow', period_s=0.1, blocking=sleeps(0.2))
    spec = unit(ONE_THREAD, timer('beat', period_s=0.05), slow)
    assert only(spec, 'CC208').message == (
        'slow takes at least 0.2 s and is due every 0.1 s, more than the only thread of the '
        'SingleThreadedExecutor has time for: beat runs about 25% as often as due'
    )


def test_those_that_ask_for_too_much_together_are_named_together() -> None:
    one = timer('one', period_s=0.1, blocking=sleeps(0.06))
    two = timer('two', period_s=0.1, blocking=sleeps(0.08))
    spec = unit(ONE_THREAD, one, two, timer('beat', period_s=0.01))
    assert only(spec, 'CC208').message == (
        'one, two together ask for 140% of the time, more than the only thread of the '
        'SingleThreadedExecutor has time for: beat runs about 7% as often as due'
    )


@pytest.mark.parametrize(
    'callbacks',
    [
        (timer('busy', period_s=0.1, blocking=sleeps(0.05)), timer('beat', period_s=0.05)),
        (timer('slow', period_s=0.1, blocking=sleeps(1.0)), timer('beat', period_s=0.05)),
    ],
    ids=['there is time', 'CC201 tells it'],
)
def test_else_no_overload_is_told(callbacks: tuple[Callback, ...]) -> None:
    found_codes = [finding[:5] for finding in found(unit(ONE_THREAD, *callbacks))]
    assert 'CC208' not in found_codes


@pytest.mark.parametrize('is_sure', [True, False], ids=['in each run', 'behind a branch'])
def test_a_timer_that_alone_takes_longer_than_its_period_is_a_note(is_sure: bool) -> None:
    slept = tuple(replace(sleep, conditional=not is_sure) for sleep in sleeps(0.2))
    spec = unit(ONE_THREAD, timer('slow', period_s=0.1, blocking=slept), subscription('on_stop'))
    finding = only(spec, 'CC208')
    assert (finding.severity, finding.message) == (
        Severity.NOTE,
        'slow takes at least 0.2 s and is due every 0.1 s, more than the only thread of the '
        'SingleThreadedExecutor has time for: slow runs about 50% as often as due'
        + ('' if is_sure else '; so it is while its runs come to this sleep'),
    )


def test_a_short_sleep_is_long_where_a_timer_misses_five_runs() -> None:
    slow = subscription('on_image', blocking=sleeps(0.2))
    assert only(unit(ONE_THREAD, slow, timer('fast', period_s=0.04)), 'CC201').message.startswith(
        'on_image sleeps 0.2 s and holds the only thread'
    )
    assert found(unit(ONE_THREAD, slow, timer('fast', period_s=0.05))) == []


@pytest.mark.parametrize(('period', 'is_late'), [(0.05, True), (1.0, False)])
def test_a_group_of_ones_own_waits_by_intention_unless_a_timer_misses_runs(
    period: float, is_late: bool
) -> None:
    slow = subscription('on_say', 'io', blocking=sleeps(2.0))
    spec = unit(
        threads(4),
        slow,
        timer('control', 'io', period_s=period),
        groups=(DEFAULT, exclusive('io')),
    )
    messages = [each.message for each in findings_of([spec], []) if each.code == 'CC201']
    said = "on_say sleeps 2 s and holds group 'io': control waits that long"
    assert messages == ([said] if is_late else [])


def test_a_timer_created_later_is_the_victim_and_never_an_earlier_one() -> None:
    early, late = timer('early'), timer('late', period_s=0.1, blocking=sleeps(0.2))
    free = timer('free', 'other')
    assert found(unit(threads(2), early, late, free)) == []
    assert only(unit(threads(2), late, early, free), 'CC202').message.endswith(
        'so early, served after it, may never run'
    )


def test_message_of_a_timer_that_takes_longer_than_its_period() -> None:
    late = timer('late', period_s=0.1, blocking=sleeps(0.2))
    finding = only(unit(threads(2), late, timer('early'), timer('free', 'other')), 'CC202')
    assert finding.message == (
        "late in the default group of 'arm' takes at least 0.2 s and is due every 0.1 s: whenever "
        'the group opens it is due, so early, served after it, may never run'
    )


def test_message_of_timers_that_leave_no_time_together() -> None:
    one = timer('one', period_s=0.1, blocking=sleeps(0.06))
    two = timer('two', period_s=0.1, duration_s=0.05, defined=at(70))
    finding = only(unit(threads(2), one, two, timer('last'), timer('free', 'other')), 'CC202')
    assert finding.message == (
        "one, two in the default group of 'arm' together ask for 110% of the time: whenever the "
        'group opens one of them is due, so last, served after them, may never run'
    )
    assert finding.place == at(70)


def test_the_publisher_of_another_program_gives_the_rate() -> None:
    busy = subscription('on_image', 'other', key='image', blocking=sleeps(0.2))
    watched = unit(threads(2), busy, subscription('on_stop', 'other', key='stop'), timer('t'))
    camera = timer('shoot', period_s=0.1, node='camera', publishes=(Act(name='image'),))

    def told(*others: Callback) -> list[str]:
        programs = [
            replace(unit(ONE_THREAD, other), name=f'program_{other.name}') for other in others
        ]
        findings = findings_of([watched, *programs], [])
        return [finding.code for finding in findings if finding.code == 'CC202']

    assert told(camera) == ['CC202']
    assert told() == []
    assert told(camera, replace(camera, name='again')) == [], 'two publish what arrives'


def test_who_is_made_only_at_times_keeps_no_group_busy() -> None:
    late = timer('late', period_s=0.1, blocking=sleeps(0.2), conditional=True)
    assert found(unit(threads(2), late, timer('early'), timer('free', 'other'))) == []


def test_one_exclusive_group_makes_many_threads_useless() -> None:
    assert found(unit(threads(4), timer('a'), timer('b'))) == ['CC401:90 warning']
    assert found(unit(default_threads(2), timer('a'), timer('b'))) == ['CC401:90 warning']
    assert found(unit(threads(4), timer('a'))) == []
    assert found(unit(threads(2), timer('a'), timer('b', 'other'))) == []
    assert found(unit(threads(4), timer('a', 'free'), timer('b', 'free'))) == []
    assert found(unit(NOT_FOUND, timer('a'), timer('b'))) == []
    task = outside('task', EntityKind.TASK)
    assert found(unit(threads(4), timer('a'), task)) == []


def test_a_hole_in_the_unit_silences_what_rests_on_the_whole() -> None:
    spec = unit(threads(4), timer('a'), timer('b'), unresolved=(HOLE,))
    assert found(spec) == ['CC501:3 note']


def test_groups_without_effect_on_one_thread() -> None:
    assert found(unit(ONE_THREAD, timer('a', 'free'), timer('b'))) == ['CC402:6 note']
    assert found(unit(ONE_THREAD, timer('a'), timer('b'))) == []
    assert found(unit(ONE_THREAD, timer('a', 'free', coroutine=True), timer('b'))) == []


@pytest.mark.parametrize('call', ['rclpy.spin_once', 'executor.spin_once', 'spin for future'])
def test_a_nested_spin_gives_groups_an_effect_on_one_thread(call: str) -> None:
    spinner = timer('a', 'other', blocking=calls('helper', call=call))
    assert 'CC402:5 note' not in found(unit(ONE_THREAD, spinner, timer('b')))


def test_an_await_gives_groups_an_effect_on_one_thread() -> None:
    waiter = timer('a', 'other', blocking=calls('helper', call='await'))
    assert found(unit(ONE_THREAD, waiter, timer('b'))) == ['CC120:40 note']


def test_the_events_executor_never_asks_the_groups() -> None:
    spinner = timer('a', 'other', blocking=calls('helper', call='rclpy.spin_once'))
    assert 'CC402:5 note' in found(unit(EVENTS_EXECUTOR, spinner, timer('b')))


def test_threads_that_never_run() -> None:
    spec = unit(threads(8), timer('a'), timer('b', 'other'), subscription('c', 'other'))
    assert only(spec, 'CC403').help == 'num_threads=2 does the same'
    assert found(unit(default_threads(8), timer('a'), timer('b', 'other'))) == []
    assert found(unit(threads(8), timer('a'), timer('b', 'free'))) == []
    spec = unit(threads(3), timer('a', 'other'), timer('b', 'g'), groups=(OTHER, exclusive('g')))
    assert found(spec) == []
    looped = timer('b', 'other', count=Unknown('a loop'))
    assert found(unit(threads(8), timer('a'), looped)) == []


def test_a_group_in_which_nothing_is() -> None:
    spec = unit(threads(2), timer('a'), timer('b', 'other'))
    empty = exclusive('forgotten', source=at(7))
    with_empty = type(spec)(**{**vars(spec), 'groups': (DEFAULT, OTHER, empty)})
    assert found(with_empty) == ['CC404:7 warning']
    hole = replace(HOLE, fact='entities')
    assert found(replace(with_empty, unresolved=(hole,))) == ['CC501:3 note']
    assert 'CC404:7 warning' in found(replace(with_empty, unresolved=(HOLE,)))
    assert FREE.name not in {group.name for group in with_empty.groups}
    more = exclusive('forgotten_2', source=at(7))
    both = replace(with_empty, groups=(*with_empty.groups, more))
    assert only(both, 'CC404').message == 'no callback uses any of the 2 groups made here'


def diagnostic(slug: str, severity: Severity) -> Diagnostic:
    return Diagnostic(severity=severity, slug=slug, place=Place('a.py', 7), message='so it is')


def test_diagnostics_become_findings_by_their_slug() -> None:
    given = [
        diagnostic('executor-not-spun', Severity.WARNING),
        diagnostic('node-taken-out', Severity.WARNING),
        diagnostic('syntax-error', Severity.ERROR),
        diagnostic('anything', Severity.NOTE),
    ]
    codes = {finding.code for finding in findings_of([], given)}
    assert codes == {'CC405', 'CC406', 'CC500', 'CC501'}


def test_the_order_of_units_does_not_matter() -> None:
    one = unit(threads(4), timer('a'), timer('b'))
    other = type(one)(**{**vars(one), 'name': 'leg'})
    assert findings_of([one, other], []) == findings_of([other, one], [])
    assert len(findings_of([one, other], [])) == 1
