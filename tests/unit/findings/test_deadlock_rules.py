"""CC1xx: which waits never end, on which executor; figures of the table are measured ones."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import (
    EVENTS_EXECUTOR,
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
    reentrant,
    service,
    sleeps,
    subscription,
    threads,
    timer,
    unit,
    updates,
    writes,
)

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.waits.workers import SINGLE
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Access, Act, Blocking
from ros2cc_extract.spec.model import Callback, EntityKind, Executor, Spec, When


def caller_and_client(executor: Executor, group: str, client_group: str) -> Spec:
    return unit(
        executor,
        timer('drive', group, blocking=calls('plan_client')),
        client('plan_client', client_group),
        subscription('on_stop', 'other'),
    )


@pytest.mark.parametrize(
    ('executor', 'client_group', 'expected'),
    [
        (threads(4), 'arm_default', ['CC101:40']),
        (NOT_FOUND, 'arm_default', ['CC101:40']),
        (ONE_THREAD, 'arm_default', ['CC102:40']),
        (EVENTS_EXECUTOR, 'arm_default', ['CC102:40']),
        (ONE_THREAD, 'other', ['CC102:40']),
        (threads(1), 'other', ['CC102:40']),
        (threads(2), 'other', []),
        (NOT_FOUND, 'other', []),
    ],
)
def test_placement_of_the_client_decides_as_measured(
    executor: Executor, client_group: str, expected: list[str]
) -> None:
    spec = caller_and_client(executor, 'arm_default', client_group)
    assert [f for f in found(spec) if f.startswith('CC1')] == expected


def test_a_reentrant_group_does_not_block_but_may_overlap_itself() -> None:
    spec = caller_and_client(threads(4), 'free', 'free')
    assert found(spec) == ['CC103:40 note']


def test_message_of_a_call_into_the_own_group() -> None:
    finding = only(caller_and_client(threads(4), 'arm_default', 'arm_default'), 'CC101')
    assert finding.message == (
        "drive waits in client.call for the answer of service 'plan', but the client is in the "
        "default group of 'arm', which is closed while drive runs: it waits forever"
    )
    assert finding.subjects == ('drive', 'plan_client')


def test_callbacks_that_wait_at_one_line_are_one_finding() -> None:
    ways = tuple(at(line) for line in (50, 60))
    spec = unit(
        threads(4),
        *(
            timer(name, blocking=calls('plan_client', chain=(way,)))
            for name, way in zip(('drive', 'turn'), ways, strict=True)
        ),
        client('plan_client'),
    )
    finding = only(spec, 'CC101')
    assert finding.message == (
        "drive, turn wait in client.call for the answer of service 'plan', but the client is in "
        "the default group of 'arm', which is closed while one of them runs: they wait forever"
    )
    assert finding.subjects == ('drive', 'turn', 'plan_client')
    assert [remark.place for remark in finding.chain] == [ways[0]]
    assert finding.related[-1] == Remark(ways[1], 'turn calls from here')


def test_a_time_out_makes_a_warning() -> None:
    spec = unit(
        threads(4),
        timer('drive', blocking=calls('plan_client', seconds=2.0)),
        client('plan_client'),
        subscription('on_stop', 'other'),
    )
    finding = only(spec, 'CC101')
    assert finding.severity is Severity.WARNING
    assert finding.message.endswith(
        'it always times out, which from Kilted on raises TimeoutError and ends the '
        'spin if it is not caught'
    )


def test_the_service_of_the_same_unit_may_be_what_is_shut_out() -> None:
    spec = unit(
        threads(4),
        timer('drive', blocking=calls('plan_client')),
        client('plan_client', 'other'),
        service('on_plan', key='plan'),
    )
    assert 'on_plan, which serves it, is in the default group' in only(spec, 'CC101').message


def test_of_two_servers_of_one_name_none_is_taken_for_the_one() -> None:
    spec = unit(
        threads(2),
        timer('drive', blocking=calls('plan_client')),
        client('plan_client', 'other'),
        service('on_plan', key='plan'),
        service('on_plan_too', 'other', key='plan'),
    )
    assert found(spec) == []


def test_a_callback_does_not_wait_for_itself() -> None:
    spec = unit(ONE_THREAD, timer('drive', blocking=calls('drive', call='Event.wait')))
    assert found(spec) == ['CC120:40 note']


def test_a_call_that_never_ends_by_itself_is_not_also_a_full_pool() -> None:
    spec = unit(
        threads(2),
        timer('drive', blocking=calls('plan_client')),
        client('plan_client'),
        timer('turn', 'other', blocking=calls('plan_client', 45)),
    )
    assert found(spec) == ['CC101:40']


@pytest.mark.parametrize('on', [None, Unknown('an argument'), 'client_of_another_unit'])
def test_an_unknown_client_gives_nothing(on: str | Unknown | None) -> None:
    spec = unit(ONE_THREAD, timer('drive', blocking=calls(on)), client('plan_client'))
    assert found(spec) == ['CC120:40 note']


def test_an_unresolved_group_gives_nothing() -> None:
    group = exclusive('g', unresolved=Unknown('an argument'))
    spec = unit(
        threads(4),
        timer('drive', 'g', blocking=calls('plan_client')),
        client('plan_client', 'g'),
        groups=(group,),
    )
    assert found(spec) == []


def test_branches_of_which_only_one_is_taken_do_not_wait_for_each_other() -> None:
    spec = unit(
        threads(2),
        timer('drive', alternative='a', blocking=calls('plan_client')),
        client('plan_client', alternative='a'),
        subscription('on_stop', 'other'),
    )
    assert found(spec) == []


def test_a_busy_wait_for_a_future_is_a_wait_unless_it_spins() -> None:
    waits = calls('plan_client', call='busy wait')
    spin = calls('helper', call='rclpy.spin_once')
    for blocking, expected in ((waits, ['CC102:40']), ((*waits, *spin), ['CC120:40 note'])):
        spec = unit(ONE_THREAD, timer('drive', blocking=blocking), client('plan_client'))
        assert found(spec) == expected


def test_a_loop_that_steps_the_own_node_waits_for_its_future_at_the_step() -> None:
    loop = (*calls('plan_client', 39, call='busy wait'), *calls('arm', call='rclpy.spin_once'))
    drive = timer('drive', blocking=loop)
    assert 'CC101:40' in found(unit(ONE_THREAD, drive, client('plan_client')))
    assert 'CC101:40' not in found(unit(ONE_THREAD, drive, client('plan_client', 'other')))


def test_an_event_that_a_member_of_the_group_sets() -> None:
    spec = unit(
        threads(4),
        timer('drive', blocking=calls('on_done', call='Event.wait')),
        subscription('on_done'),
        subscription('on_stop', 'other'),
    )
    assert found(spec) == ['CC101:40', 'CC403:90 note']
    finding = only(spec, 'CC101')
    assert finding.message.endswith('waits forever, unless the event is already set')
    assert finding.help == 'give on_done a callback group of its own'


def test_a_done_callback_needs_the_client_of_its_answer() -> None:
    def spec(executor: Executor, group: str) -> Spec:
        return unit(
            executor,
            timer('drive', blocking=calls('on_answer', call='Event.wait')),
            client('plan_client', group),
            outside('on_answer', EntityKind.DONE_CALLBACK, key='plan'),
        )

    assert found(spec(ONE_THREAD, 'other'))[0] == 'CC102:40'
    assert found(spec(threads(2), 'other')) == []
    finding = only(spec(threads(2), 'arm_default'), 'CC101')
    assert finding.message == (
        "drive waits in Event.wait for the answer of service 'plan', but the client is in the "
        "default group of 'arm', which is closed while drive runs: it waits forever"
    )


def blockers(number: int, executor: Executor, group: str = '', **facts: object) -> Spec:
    """``number`` timers that wait for a client, each in a group of its own or all in one."""
    names = [f'g{index}' for index in range(number)]
    timers = [
        timer(f'arm_{n}', group or n, blocking=calls('plan_client', 40 + i), **facts)
        for i, n in enumerate(names)
    ]
    groups = (*map(exclusive, names), OTHER, reentrant('free'), exclusive('one'))
    return unit(executor, *timers, client('plan_client', 'other'), groups=groups)


@pytest.mark.parametrize(
    ('number', 'workers', 'expected'), [(2, 2, ['CC103:40']), (2, 3, []), (4, 3, ['CC103:40'])]
)
def test_pool_is_exhausted_by_as_many_waiters_as_threads(
    number: int, workers: int, expected: list[str]
) -> None:
    assert found(blockers(number, threads(workers))) == expected


def test_the_smallest_sufficient_number_is_named() -> None:
    finding = only(blockers(4, threads(4)), 'CC103')
    assert finding.help == '5 threads are the smallest number that is enough'
    assert [remark.place for remark in finding.related] == [at(41), at(42), at(43)]


def test_an_exclusive_group_counts_once() -> None:
    assert found(blockers(4, threads(2), group='one')) == []


def test_exclusive_branches_count_once() -> None:
    assert 'CC103:40' not in found(blockers(4, threads(2), alternative='either'))


@pytest.mark.parametrize(('branches', 'expected'), [((0, 0, 1), True), ((0, 1, 2), False)])
def test_waiters_of_one_branch_count_together(branches: tuple[int, ...], expected: bool) -> None:
    spec = blockers(3, threads(2), alternative='either')
    timers = [replace(c, branch=n) for c, n in zip(spec.callbacks, branches, strict=False)]
    spec = replace(spec, callbacks=(*timers, *spec.callbacks[len(timers) :]))
    assert ('CC103:40' in found(spec)) is expected


@pytest.mark.parametrize('order', [(0, 1, 2), (1, 2, 0), (2, 1, 0)])
def test_groups_and_branches_are_matched_as_well_as_can_be(order: tuple[int, ...]) -> None:
    """Group g0 has a member in each of two branches, g1 only in the first: both can wait."""
    waits = calls('plan_client', 40)
    either = [
        timer('left', 'g0', alternative='a', blocking=waits),
        timer('right', 'g0', alternative='b', blocking=waits),
        timer('third', 'g1', alternative='a', blocking=waits),
    ]
    groups = (exclusive('g0'), exclusive('g1'), OTHER)
    timers = [either[n] for n in order]
    client_ = client('plan_client', 'other')
    assert 'CC103:40' in found(unit(threads(2), *timers, client_, groups=groups))
    assert 'CC103:40' not in found(unit(threads(3), *timers, client_, groups=groups))


def test_entities_that_a_callback_makes_do_not_count() -> None:
    assert found(blockers(2, threads(2), when=When.CALLBACK)) == []


def test_reentrant_waiters_overlap_themselves_so_no_number_is_enough() -> None:
    finding = only(blockers(4, threads(4), group='free'), 'CC103')
    assert finding.severity is Severity.ERROR
    assert 'no number is certainly enough' in finding.help


@pytest.mark.parametrize(
    ('executor', 'runs'), [(threads(4), '4 runs'), (default_threads(4), 'as many runs')]
)
def test_sleeps_by_a_rate_that_overlap_hold_every_thread(executor: Executor, runs: str) -> None:
    """Measured on 7.1.6: a timer of 10 Hz, a rate of 2 Hz, 4 threads: no sleep ends in 6 s."""
    wait = calls('rate_timer', call='Rate.sleep')
    finding = only(unit(executor, subscription('on_scan', 'free', blocking=wait)), 'CC103')
    assert finding.severity is Severity.WARNING
    assert finding.message.startswith(f'on_scan may overlap itself in Rate.sleep; {runs} ')
    assert found(unit(executor, subscription('on_scan', 'other', blocking=wait))) == [
        'CC120:40 note'
    ]
    goals = outside('execute', EntityKind.ACTION_EXECUTE, blocking=wait)
    assert only(unit(executor, goals), 'CC103').severity is Severity.NOTE


def test_overlapping_waits_on_the_default_pool_are_a_note() -> None:
    caller = subscription('on_goal', 'free', blocking=calls('plan_client'))
    spec = unit(default_threads(4), caller, client('plan_client', 'other'))
    assert only(spec, 'CC103').severity is Severity.NOTE


@pytest.mark.parametrize(
    ('claim', 'expected'),
    [
        pytest.param(writes('Arm.busy', 31, 'Arm.lock'), [], id='claimed'),
        pytest.param(writes('Arm.busy', 31), ['CC103:40 note'], id='without the lock'),
        pytest.param(writes('Arm.busy', 29, 'Arm.lock'), ['CC103:40 note'], id='not looked at'),
        pytest.param(writes('Arm.busy', 41, 'Arm.lock'), ['CC103:40 note'], id='after the wait'),
        pytest.param(updates('Arm.busy', 31, 'Arm.lock'), ['CC103:40 note'], id='counted'),
        pytest.param(writes('Arm.goal', 31, 'Arm.lock'), ['CC103:40 note'], id='another'),
    ],
)
def test_a_state_claimed_under_a_lock_lets_one_run_wait(
    claim: tuple[Access, ...], expected: list[str]
) -> None:
    look, given_back = writes('Arm.busy', 30, 'Arm.lock'), writes('Arm.busy', 50, 'Arm.lock')
    caller = service(
        'on_go', 'free', reads=look, writes=(*claim, *given_back), blocking=calls('plan_client')
    )
    spec = unit(threads(4), caller, client('plan_client', 'other'))
    assert [line for line in found(spec) if 'CC103' in line] == expected
    looks_again = replace(caller, reads=(*look, *writes('Arm.busy', 45, 'Arm.lock')))
    waits_again = replace(caller, blocking=(*caller.blocking, *calls('plan_client', 60)))
    for other in (looks_again, waits_again):
        assert 'CC103:40 note' in found(unit(threads(4), other, client('plan_client', 'other')))


def test_the_default_thread_count_is_that_of_the_machine() -> None:
    finding = only(blockers(4, default_threads(4)), 'CC103')
    assert 'on a machine with 4 or fewer CPUs' in finding.message
    assert found(blockers(2, default_threads(2))) == ['CC103:40 note']
    assert found(blockers(1, default_threads(2))) == []


def test_an_unknown_thread_count_gives_a_note() -> None:
    executor = replace(threads(2), unresolved=Unknown('thread count is a parameter'))
    assert found(blockers(2, executor)) == ['CC103:40 note']


def test_await_within_the_own_group_never_resumes() -> None:
    def spec(executor: Executor, group: str) -> Spec:
        waits = calls('plan_client', call='await')
        return unit(
            executor,
            service('on_open', coroutine=True, blocking=waits, key='open'),
            client('plan_client', group),
        )

    assert found(spec(ONE_THREAD, 'arm_default')) == ['CC104:40']
    assert 'CC104:40' in found(spec(threads(4), 'arm_default'))
    assert found(spec(NOT_FOUND, 'arm_default')) == ['CC104:40 warning']
    events = spec(EVENTS_EXECUTOR, 'arm_default')
    assert found(events) == ['CC113:0 warning']
    assert found(replace(events, rclpy='7.1.6')) == ['CC113:0']
    assert found(replace(events, rclpy='9.1.2')) == []
    assert found(spec(ONE_THREAD, 'other')) == []


def test_rate_sleep_needs_a_second_thread() -> None:
    def spec(executor: Executor) -> Spec:
        return unit(
            executor,
            subscription('on_go', blocking=calls(None, call='Rate.sleep')),
            subscription('on_stop', 'other'),
        )

    assert [f for f in found(spec(ONE_THREAD)) if f.startswith('CC1')] == ['CC105:40']
    assert [f for f in found(spec(threads(1))) if f.startswith('CC1')] == ['CC105:40']
    assert found(spec(threads(2))) == ['CC120:40 note']
    assert found(spec(NOT_FOUND)) == ['CC120:40 note']


def nested(executor: Executor, on: str | None, call: str) -> list[str]:
    spec = unit(executor, timer('tick', blocking=calls(on, call=call)))
    return [f for f in found(spec) if f.startswith('CC1')]


def test_nested_spin_takes_the_node_out_of_its_executor() -> None:
    call = 'rclpy.spin_until_future_complete'
    assert nested(threads(4), 'arm', call) == ['CC106:40']
    assert nested(NOT_FOUND, 'arm', call) == ['CC106:40 warning']
    assert nested(replace(ONE_THREAD, spun='rclpy.spin'), 'arm', call) == ['CC106:40 warning']
    assert nested(threads(4), None, call) == ['CC106:40 note']
    assert nested(threads(4), 'helper', call) == ['CC120:40 note']


def test_callbacks_that_come_to_one_nested_spin_are_one_finding() -> None:
    spins = calls('arm', call='rclpy.spin_until_future_complete')
    two = unit(threads(4), timer('tick', blocking=spins * 2), timer('tock', blocking=spins))
    finding = only(two, 'CC106')
    assert finding.message.startswith(
        "tick, tock call rclpy.spin_until_future_complete on node 'arm' inside callbacks: "
    )
    assert finding.subjects == ('tick', 'tock')
    one = unit(threads(4), timer('tick', blocking=spins))
    assert only(one, 'CC106').message.startswith('tick calls ')


def test_nested_spin_on_another_executor_that_is_named_loses_the_node_everywhere() -> None:
    """Also under ``rclpy.spin``, whose executor is then not the one that is spun."""
    spins = calls('arm', call='rclpy.spin_once')
    moves = tuple(Act(name='executor.add_node', source=spin.source) for spin in spins)
    spec = unit(
        replace(ONE_THREAD, spun='rclpy.spin'), timer('tick', blocking=spins, changes=moves)
    )
    assert [f for f in found(spec) if f.startswith('CC1')] == ['CC106:40']


def test_a_nested_spin_for_a_client_of_the_own_group_never_ends() -> None:
    waits = calls('plan_client', call='spin for future')
    for executor, group, expected in (
        (ONE_THREAD, 'arm_default', ['CC101:40']),
        (threads(2), 'arm_default', ['CC101:40']),
        (EVENTS_EXECUTOR, 'arm_default', ['CC120:40 note']),
        (ONE_THREAD, 'other', ['CC120:40 note']),
    ):
        spec = unit(executor, timer('drive', blocking=waits), client('plan_client', group))
        assert [f for f in found(spec) if f.startswith('CC1')] == expected


def test_asyncio_sleep_kills_a_coroutine_but_a_sleep_of_zero_yields() -> None:
    def spec(seconds: float | Unknown, coroutine: bool = True) -> Spec:
        waits = calls(None, call='asyncio.sleep', seconds=seconds)
        return unit(ONE_THREAD, timer('grip', coroutine=coroutine, blocking=waits))

    assert found(spec(1.0)) == ['CC108:40']
    assert found(spec(0.0)) == []
    assert found(spec(Unknown('a parameter'))) == []
    assert found(spec(1.0, coroutine=False)) == []


def test_an_executor_spun_by_its_own_callback() -> None:
    assert nested(threads(4), 'executor', 'executor.spin_once') == ['CC107:40 warning']
    assert nested(threads(4), 'another', 'executor.spin_once') == ['CC120:40 note']


def test_a_nested_spin_that_can_run_nothing_else_is_a_note_where_nothing_refuses_it() -> None:
    def of(release: str | None, *more: Callback) -> list[str]:
        waits = calls('executor', call='executor.spin_once')
        spec = unit(ONE_THREAD, timer('tick', blocking=waits), timer('tock'), *more)
        return [each for each in found(replace(spec, rclpy=release)) if each.startswith('CC1')]

    assert of('7.1.6') == ['CC107:40 note']
    assert of('7.1.6', timer('blink', 'other')) == ['CC107:40 warning']
    assert of('7.1.9') == ['CC107:40']
    assert of(None) == ['CC107:40 warning']


def test_execute_callback_waits_outside_every_group() -> None:
    execute = outside('execute', EntityKind.ACTION_EXECUTE, blocking=calls('plan_client'))
    assert found(unit(ONE_THREAD, execute, client('plan_client'))) == ['CC102:40']
    assert found(unit(threads(4), execute, client('plan_client'))) == ['CC103:40 note']


def test_a_sleep_is_no_wait_for_others() -> None:
    assert found(unit(threads(2), timer('a', blocking=sleeps(0.2)), timer('b', 'other'))) == []


def test_the_chain_leads_from_the_callback_to_the_wait() -> None:
    waits = calls('plan_client', chain=(at(30), at(35)))
    spec = unit(ONE_THREAD, timer('drive', blocking=waits), client('plan_client'))
    chain = only(spec, 'CC102').chain
    assert [(remark.place, remark.text) for remark in chain] == [
        (at(30), 'drive calls from here'),
        (at(35), 'and on from here'),
    ]


@pytest.mark.parametrize(
    ('kind', 'remedy'),
    [
        (
            EntityKind.ACTION_EXECUTE,
            'no group holds an execute callback: accept one goal at a time in goal_callback',
        ),
        (EntityKind.TASK, 'no group holds a task: do not wait in it'),
        (
            EntityKind.DONE_CALLBACK,
            'no group holds a done-callback: do not wait in it',
        ),
    ],
)
def test_the_help_for_a_full_pool_names_no_group_for_what_is_in_none(
    kind: EntityKind, remedy: str
) -> None:
    runner = outside('run', kind, blocking=calls('plan_client'))
    finding = only(unit(threads(4), runner, client('plan_client', 'other')), 'CC103')
    assert finding.help == f'{remedy}; then 2 threads are enough'


@pytest.mark.parametrize('kind', [EntityKind.TASK, EntityKind.DONE_CALLBACK])
def test_a_task_made_once_never_overlaps_itself(kind: EntityKind) -> None:
    plan = client('plan_client', 'other')
    once = outside('run', kind, blocking=calls('plan_client'), source=at(80))
    assert found(unit(threads(2), once, plan)) == []
    many = replace(once, count=Unknown('made in a loop')), replace(once, source=None)
    for each in many:
        assert found(unit(threads(2), each, plan)) == ['CC103:40 note']


def test_the_help_for_a_full_pool_names_the_group_of_others() -> None:
    caller = subscription('on_goal', 'free', blocking=calls('plan_client'))
    finding = only(unit(threads(4), caller, client('plan_client', 'other')), 'CC103')
    assert finding.help == (
        'put it into a mutually exclusive group of its own; then 2 threads are enough'
    )
    goal = outside('run', EntityKind.ACTION_EXECUTE, blocking=calls('plan_client'))
    both = unit(threads(3), goal, caller, client('plan_client', 'other'))
    assert only(both, 'CC103').help.startswith(
        'put on_goal into a mutually exclusive group of its own; no group holds an execute'
    )


def test_a_done_callback_that_spins_has_no_group_that_would_stay_closed() -> None:
    spin = calls('arm', call='rclpy.spin_once')
    under_spin = Executor(
        name='executor', kind=SINGLE, threads=('thread_0',), spun='rclpy.spin', source=at(90)
    )
    done = outside('on_done', EntityKind.DONE_CALLBACK, blocking=spin)
    assert (
        'callbacks of the node run inside this one, and from rclpy 7.1.9'
        in only(unit(under_spin, done, timer('t')), 'CC106').message
    )
    tick = timer('tick', blocking=spin)
    assert 'members of its own group do not' in only(unit(under_spin, tick), 'CC106').message
    free = timer('tick', 'free', blocking=spin)
    assert 'members of its own' not in only(unit(under_spin, free), 'CC106').message


@pytest.mark.parametrize(
    ('seconds', 'words'),
    [
        ((None, None), 'all wait forever'),
        ((1.0, 1.0), 'all waits time out'),
        ((1.0, None), 'all wait, at least until the first time-out'),
    ],
)
def test_what_becomes_of_a_pool_that_is_used_up(
    seconds: tuple[float | None, ...], words: str
) -> None:
    timers = [
        timer(f'ask_{number}', name, blocking=calls('plan_client', seconds=limit))
        for number, (name, limit) in enumerate(zip(('arm_default', 'other'), seconds, strict=True))
    ]
    finding = only(unit(threads(2), *timers, client('plan_client', 'free')), 'CC103')
    assert finding.message.endswith(words)


def recorders(number: int, *, pauses: bool = True, timed: bool = True) -> list[str]:
    """Two callbacks that look again and again whether ``cut`` has written something."""
    seconds = Unknown('the loop also ends otherwise') if timed else None
    loop = Blocking(call='polling loop', on='cut', seconds=seconds, source=at(40))
    blocking = (*sleeps(0.1), loop) if pauses else (loop,)
    callbacks = [service(f'take_{side}', side, blocking=blocking) for side in ('left', 'right')]
    spec = unit(
        threads(number),
        *callbacks,
        subscription('cut', 'other'),
        groups=(OTHER, exclusive('left'), exclusive('right')),
    )
    return [code for code in found(spec) if code.startswith('CC103')]


@pytest.mark.parametrize('number', [1, 2])
def test_a_loop_that_looks_for_a_time_at_what_only_a_blocked_callback_writes(number: int) -> None:
    loop = Blocking(call='polling loop', on='cut', seconds=Unknown('a clock'), source=at(40))
    callbacks = (service('take', blocking=(loop,)), subscription('cut'))
    one = only(unit(threads(number), *callbacks), 'CC102' if number == 1 else 'CC101')
    assert (one.severity, one.place) == (Severity.WARNING, at(40))
    assert one.message.endswith(
        ': unless the data is there at once, it goes on for all of its time'
    )


def test_loops_that_end_by_time_too_may_take_all_threads() -> None:
    assert recorders(2) == ['CC103:40 warning']
    assert recorders(3) == []
    assert recorders(2, pauses=False) == []
    assert recorders(2, timed=False) == []


def test_calls_of_several_clients_at_one_line_are_one_finding() -> None:
    names = ('plan', 'map', 'grip', 'home')
    blocking = tuple(block for name in names for block in calls(name))
    callbacks = (timer('drive', blocking=blocking), *(client(n, key=n) for n in names))
    of_group = only(unit(threads(2), *callbacks), 'CC101')
    assert of_group.message == (
        "drive waits in client.call for the answers of service 'plan', service 'map', service "
        "'grip' and 1 more, but the clients are in the default group of 'arm', which is closed "
        'while drive runs: it waits forever'
    )
    assert of_group.subjects == ('drive', *names)
    assert of_group.help.startswith('give the clients another callback group, or ')
    of_thread = only(unit(ONE_THREAD, *callbacks), 'CC102')
    assert 'and 1 more on the only thread' in of_thread.message
    assert 'so nothing can take them: it waits forever' in of_thread.message


def test_a_function_that_calls_itself_is_ended_by_an_error() -> None:
    waits = tuple(replace(wait, recursive=True) for wait in calls('plan_client', call='busy wait'))
    spec = unit(threads(2), timer('drive', blocking=waits), client('plan_client'))
    assert only(spec, 'CC101').message == (
        "drive waits in a function that calls itself for the answer of service 'plan', but the "
        "client is in the default group of 'arm', which is closed while drive runs: "
        'RecursionError ends it after some 1,000 calls'
    )


def test_whoever_waits_several_times_is_counted_and_named_so() -> None:
    waits = calls('plan_client')
    names = ('left', 'right', 'stop')
    timers = [
        timer(name, f'of_{name}', function='arm.Arm.drive', defined=at(20), blocking=waits)
        for name in names[:2]
    ]
    stop = timer('stop', 'of_stop', blocking=waits)
    groups = (*(exclusive(f'of_{name}') for name in names), OTHER)
    spec = unit(threads(3), *timers, stop, client('plan_client', 'other'), groups=groups)
    assert only(spec, 'CC103').message == (
        '3 callbacks can wait at the same time (Arm.drive 2 times, stop) on 3 threads: then none '
        'is left for the answers and all wait forever'
    )
