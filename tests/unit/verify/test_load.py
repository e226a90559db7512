"""Starvation judged by rates, compared with what was counted on rclpy 7.1.6 and 9.1.2."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Act, Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Distribution,
    EntityKind,
    Executor,
    GroupType,
    Measured,
    Spec,
)
from ros2cc_extract.verify.results.load import Load, LoadKind, demands_of, load_of, served_before

MULTI, SINGLE = 'MultiThreadedExecutor', 'SingleThreadedExecutor'


def timer(name: str, period_s: float, duration_s: float | None, group: str = 'group') -> Callback:
    return Callback(
        name=name,
        type=CallbackType.TMR,
        entity=EntityKind.TIMER,
        group=group,
        period_s=period_s,
        duration_s=duration_s,
    )


def subscription(name: str, period_s: float | None, duration_s: float | None) -> Callback:
    return Callback(
        name=name,
        type=CallbackType.SUB,
        entity=EntityKind.SUBSCRIPTION,
        group='group',
        key=f'msg_{name}',
        period_s=period_s,
        duration_s=duration_s,
    )


def unit(
    *callbacks: Callback,
    kind: str = MULTI,
    threads: int = 4,
    group: GroupType = GroupType.EXCLUSIVE,
) -> Spec:
    names = dict.fromkeys(callback.group for callback in callbacks)
    return Spec(
        name='unit',
        callbacks=callbacks,
        groups=tuple(CallbackGroup(name=name, type=group) for name in names),
        executor=Executor(
            name='executor', kind=kind, threads=tuple(f'thread_{n}' for n in range(threads))
        ),
    )


def load(spec: Spec, name: str, *others: Spec) -> Load:
    callback = next(c for c in spec.callbacks if c.name == name)
    return load_of(spec, callback, demands_of(spec, others))


def paper_case(c_every: float, **how: object) -> Spec:
    """Unit 1 s: SUB1 works 1 s on msg_C, SUB2 2 s on msg_D, which comes every 2 s."""
    return unit(
        timer('TMR1', 1.0, 0.0),
        timer('TMR2', 1.0, 0.0),
        subscription('SUB1', c_every, 1.0),
        subscription('SUB2', 2.0, 2.0),
        **how,  # type: ignore[arg-type]
    )


def two_timers(total: float) -> Spec:
    """Each works for half the load of its period of 0.2 s."""
    return unit(*(timer(name, 0.2, 0.1 * total) for name in ('first', 'second')))


# Counted in 8 s, so 40 due: load, kind and runs of the second timer.
COUNTED = [
    (0.5, LoadKind.FINE, 39),
    (0.9, LoadKind.FINE, 39),
    (1.0, LoadKind.FINE, 39),
    (1.2, LoadKind.DEGRADED, 26),
    (1.9, LoadKind.DEGRADED, 2),
    (2.1, LoadKind.STARVED, 0),
]


@pytest.mark.parametrize(('total', 'kind', 'runs'), COUNTED)
def test_two_timers_of_one_group_as_counted(total: float, kind: LoadKind, runs: int) -> None:
    told = load(two_timers(total), 'second')
    assert told.kind is kind
    assert told.runs is not None
    assert 40 * told.runs == pytest.approx(runs, abs=1.01)
    assert load(two_timers(total), 'first').kind is LoadKind.FINE


# Counted over 60 units: how often C comes, and runs of SUB2 of 30 due.
PAPER_CASE_2 = [(1, 0), (1.05, 1), (1.1, 2), (1.25, 5), (1.5, 9), (2, 15), (3, 19)]


@pytest.mark.parametrize(('c_every', 'runs'), PAPER_CASE_2)
def test_second_subscription_of_paper_case_2_as_counted(c_every: float, runs: int) -> None:
    told = load(paper_case(c_every), 'SUB2')
    assert told.runs is not None
    assert 30 * told.runs == pytest.approx(runs, abs=1.01)


def test_paper_case_2_in_words() -> None:
    words = {c: load(paper_case(c), 'SUB2').words for c in (1, 1.5, 2, 4)}
    assert words == {
        1: 'starved (load 1.00)',
        1.5: 'degraded (load 0.67; about 33% of its arrivals are served)',
        2: 'fine at these rates (load 0.50; about 50% of its arrivals are served)',
        4: 'fine at these rates (load 0.25; about 75% of its arrivals are served)',
    }
    assert load(paper_case(1), 'SUB1').words == 'fine at these rates (load 0.00)'


def test_order_of_creation_decides_who_starves() -> None:
    spec = paper_case(1)
    turned = replace(spec, callbacks=(*spec.callbacks[:2], *spec.callbacks[:1:-1]))
    assert load(turned, 'SUB1').words == 'starved (load 1.00)'
    assert load(turned, 'SUB2').kind is LoadKind.FINE


def test_one_thread_serves_all_in_turns() -> None:
    """Counted in paper case 1: 20 of 60 and 20 of 30."""
    spec = paper_case(1, kind=SINGLE, threads=1)
    told = [load(spec, name) for name in ('SUB1', 'SUB2')]
    assert [each.runs for each in told] == [pytest.approx(1 / 3), pytest.approx(2 / 3)]
    assert {each.kind for each in told} == {LoadKind.DEGRADED}


def test_a_pool_of_one_worker_refuses_nobody() -> None:
    assert load(paper_case(1, threads=1), 'SUB2').kind is LoadKind.DEGRADED


def test_who_is_seldom_due_gets_every_turn_of_a_busy_thread() -> None:
    spec = unit(timer('busy', 0.1, 0.3), timer('rare', 5.0, 0.1), kind=SINGLE, threads=1)
    assert load(spec, 'rare').kind is LoadKind.FINE
    assert load(spec, 'busy').runs == pytest.approx(0.1 / (0.3 / (1 - 0.02)))


def test_reentrant_members_share_the_threads() -> None:
    spec = paper_case(1, group=GroupType.REENTRANT)
    assert load(spec, 'SUB2').words == 'fine at these rates (load 0.50)'
    crowded = replace(spec, executor=replace(spec.executor, threads=('t0', 't1')))
    assert load(crowded, 'SUB2').kind is LoadKind.FINE
    more = unit(
        *(timer(f't{n}', 1.0, 1.0) for n in range(3)), threads=2, group=GroupType.REENTRANT
    )
    assert load(more, 't2').words == ('degraded (load 1.50; about 67% of its arrivals are served)')


def test_serving_order_is_by_kind_then_creation() -> None:
    late = timer('late', 1.0, 0.0)
    spec = unit(subscription('SUB1', 1.0, 1.0), subscription('SUB2', 1.0, 1.0), late)
    assert [c.name for c in served_before(spec.callbacks[1], spec)] == ['late', 'SUB1']
    assert served_before(late, spec) == ()


def test_unknown_rates_claim_nothing() -> None:
    spec = unit(subscription('SUB1', None, 1.0), subscription('SUB2', 2.0, 2.0))
    told = load(spec, 'SUB2')
    assert told.words == 'possible under overload; rates unknown'
    assert told.unknown == ('SUB1',)


def test_sleeps_of_the_source_are_the_least_a_run_takes() -> None:
    sleeper = replace(
        timer('sleeper', 0.2, None), blocking=(Blocking(call='time.sleep', seconds=0.3),)
    )
    spec = unit(sleeper, timer('victim', 0.2, None))
    assert load(spec, 'victim').words == 'starved (load 1.50)'
    shorter = replace(sleeper, blocking=(Blocking(call='time.sleep', seconds=0.1),))
    assert load(unit(shorter, timer('victim', 0.2, None)), 'victim').kind is LoadKind.UNKNOWN


def test_a_sleep_of_unknown_length_counts_nothing() -> None:
    sleeper = replace(
        timer('sleeper', 0.2, None),
        blocking=(Blocking(call='time.sleep', seconds=Unknown('a parameter')),),
    )
    assert load(unit(sleeper, timer('victim', 0.2, 0.1)), 'victim').before == 0


def measured(
    callback: Callback, period_s: float, duration_s: float, slow_s: float | None = None
) -> Callback:
    def exactly(value: float) -> Distribution:
        return Distribution(min_s=value, median_s=value, p99_s=value, max_s=value)

    duration = exactly(duration_s)
    if slow_s is not None:
        duration = replace(duration, p99_s=slow_s, max_s=slow_s)
    what = Measured(count=50, period=exactly(period_s), duration=duration)
    return replace(callback, measured=what)


def test_runs_of_a_busy_node_come_a_little_late() -> None:
    """SUB1 works 1.0 s and begins every 1.01 s: serving takes time too."""
    busy = measured(subscription('SUB1', None, None), 1.01, 1.0)
    spec = unit(busy, subscription('SUB2', 2.0, 2.0))
    assert load(spec, 'SUB2').words == 'starved (load 0.99 by medians)'


def test_a_measured_node_with_time_left_is_fine() -> None:
    spec = unit(
        measured(subscription('SUB1', None, None), 1.0, 0.3),
        measured(subscription('SUB2', None, None), 1.0, 0.3),
    )
    assert load(spec, 'SUB2').words == 'fine at these rates (load 0.30 by medians)'


def test_slow_runs_are_told_beside_medians() -> None:
    """One run in a hundred takes five times as long, and then nobody else gets a turn."""
    busy = measured(subscription('SUB1', None, None), 1.0, 0.3, slow_s=1.5)
    victim = subscription('SUB2', 10.0, 0.5)
    in_words = {
        'group': load(unit(busy, victim), 'SUB2').words,
        'thread': load(unit(busy, victim, kind=SINGLE, threads=1), 'SUB2').words,
        'pool': load(unit(busy, victim, group=GroupType.REENTRANT), 'SUB2').words,
        'the first': load(unit(busy, victim), 'SUB1').words,
    }
    assert in_words == {
        'group': 'fine at these rates (load 0.30 by medians, 1.50 in slow runs)',
        'thread': 'fine at these rates (load 0.35 by medians, 1.55 in slow runs)',
        'pool': 'fine at these rates (load 0.09 by medians, 0.39 in slow runs)',
        'the first': 'fine at these rates (load 0.00)',
    }


def test_an_exclusive_group_never_wants_more_than_one_thread() -> None:
    """Half of the time of two threads, and a tenth of a reentrant group beside it."""
    busy = measured(subscription('SUB1', None, None), 1.0, 0.3, slow_s=1.5)
    free = replace(timer('other', 1.0, 0.2), group='free')
    spec = unit(busy, free, threads=2)
    groups = (spec.groups[0], replace(spec.groups[1], type=GroupType.REENTRANT))
    assert load(replace(spec, groups=groups), 'other').words == (
        'fine at these rates (load 0.25 by medians, 0.60 in slow runs)'
    )


def test_what_was_stated_is_no_median() -> None:
    busy = measured(subscription('SUB1', 1.0, 0.3), 1.0, 0.4, slow_s=1.5)
    words = load(unit(busy, subscription('SUB2', 10.0, 0.5)), 'SUB2').words
    assert words == 'fine at these rates (load 0.30)'


def test_a_victim_does_not_measure_how_often_it_should_run() -> None:
    spec = unit(
        measured(subscription('SUB1', None, None), 1.0, 0.9),
        measured(subscription('SUB2', None, None), 20.0, 1.9),
    )
    assert load(spec, 'SUB2').kind is LoadKind.DEGRADED


def test_the_timer_that_publishes_a_topic_gives_its_rate() -> None:
    publisher = replace(timer('talk', 1.0, 0.0), publishes=(Act(name='msg_SUB1'),))
    other = replace(unit(publisher, kind=SINGLE, threads=1), name='talker')
    spec = unit(subscription('SUB1', None, 1.0), subscription('SUB2', 2.0, 2.0))
    assert load(spec, 'SUB2', other).words == 'starved (load 1.00)'


def test_what_comes_once_or_perhaps_has_no_rate() -> None:
    once = replace(timer('once', 0.1, 1.0), one_shot=True)
    assert load(unit(once, timer('other', 1.0, 0.1)), 'other').kind is LoadKind.UNKNOWN


def test_a_run_that_saw_a_member_starve_is_believed() -> None:
    """Unit 0.04 s on a busy machine: the load measured stays below 1, the victim never ran."""
    busy = measured(subscription('SUB1', None, None), 0.0448, 0.041)
    victim = replace(subscription('SUB2', None, None), measured=Measured(count=0, refused=69))
    assert load(unit(busy, victim), 'SUB2').words == (
        'starved (load 0.92 by medians; in a run it was refused 69 times and ran 0 times)'
    )
    served = replace(victim, measured=Measured(count=15, refused=30))
    assert load(unit(busy, served), 'SUB2').kind is not LoadKind.STARVED


def test_what_rclpy_adds_to_every_node_takes_no_time() -> None:
    event = Callback(
        name='event',
        type=CallbackType.SUB,
        entity=EntityKind.QOS_EVENT,
        group='group',
        builtin=True,
    )
    spec = unit(subscription('SUB1', 1.0, 0.3), subscription('SUB2', 1.0, 0.3), event)
    assert load(spec, 'SUB2').words == 'fine at these rates (load 0.30)'


def test_below_full_load_a_member_may_starve_where_groups_share_threads() -> None:
    """On two threads the fourth timer never ran on rclpy 7.1.6: 30, 29, 29 and 0 runs."""
    timers = [timer(f't{n}', 0.4, 0.2, group) for n, group in enumerate(('a', 'b', 'shared'))]
    last = timer('last', 0.4, 0.004, 'shared')
    told = load_of(unit(*timers, last, threads=2), last)
    assert (told.kind, told.runs) == (LoadKind.UNDECIDED, None)
    assert told.words == (
        'not decided without times (load 0.50; 3 may want a thread at a time, and there are fewer)'
    )
    assert load_of(unit(*timers, last, threads=3), last).kind is LoadKind.FINE


def test_whoever_is_served_first_in_its_group_is_refused_now_and_then_only() -> None:
    timers = [timer(f't{n}', 0.4, 0.1, f'g{n}') for n in range(3)]
    assert {load_of(unit(*timers, threads=2), each).kind for each in timers} == {LoadKind.FINE}


def test_a_reentrant_callback_that_overlaps_itself_wants_several_threads() -> None:
    members = timer('first', 1, 0.1, 'pair'), timer('second', 1, 0.1, 'pair')
    free = timer('alone', 0.5, 0.8, 'free')
    kinds = {'pair': GroupType.EXCLUSIVE, 'free': GroupType.REENTRANT}
    spec = unit(*members, free, threads=3)
    groups = tuple(replace(group, type=kinds[group.name]) for group in spec.groups)
    spec = replace(spec, groups=groups)
    assert load_of(spec, members[1]).kind is LoadKind.FINE
    two = replace(spec, executor=replace(spec.executor, threads=spec.executor.threads[:2]))
    assert load_of(two, members[1]).kind is LoadKind.UNDECIDED
