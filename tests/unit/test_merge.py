"""Comparing and merging two specifications of one program."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.compare.merge import Difference, Kind, diff, match_units, merge_units
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Origin,
    Spec,
    When,
)

AT = Place('arm.py', 12, 9)
SEEN = Place('arm.py', 12)
TICK = Callback(
    name='tick',
    type=CallbackType.TMR,
    group='arm_default',
    entity=EntityKind.TIMER,
    node='arm',
    function='arm.Arm.tick',
    period_s=0.5,
    source=AT,
)
ON_JOINT = Callback(
    name='on_joint',
    type=CallbackType.SUB,
    group='g',
    entity=EntityKind.SUBSCRIPTION,
    node='arm',
    function='arm.Arm.on_joint',
    key='joint_states',
    source=AT,
)
STATIC = Spec(
    name='arm',
    nodes=('arm',),
    origin=Origin.STATIC,
    callbacks=(TICK, ON_JOINT),
    groups=(
        CallbackGroup(name='arm_default', type=GroupType.EXCLUSIVE, default=True, node='arm'),
        CallbackGroup(name='g', type=GroupType.REENTRANT),
    ),
    executor=Executor(name='ex', kind='MultiThreadedExecutor', threads=('thread_0', 'thread_1')),
)
LIVE = replace(
    STATIC,
    origin=Origin.LIVE,
    callbacks=(
        replace(ON_JOINT, key='/joint_states', group='group_1', source=SEEN),
        replace(TICK, source=SEEN),
    ),
    groups=(STATIC.groups[0], replace(STATIC.groups[1], name='group_1')),
)


def test_names_of_groups_order_and_leading_slashes_make_no_difference() -> None:
    assert diff([STATIC], [LIVE]) == ()


def test_a_callback_that_one_side_lacks_is_told_with_its_place() -> None:
    live = replace(LIVE, callbacks=LIVE.callbacks[:1])
    assert diff([STATIC], [live]) == (
        Difference(
            kind=Kind.ONLY_LEFT,
            unit='arm',
            subject='tick',
            fact='callback',
            left='TMR 0.5 s',
            left_place=AT,
        ),
    )


@pytest.mark.parametrize(
    'mark',
    [{'conditional': True}, {'when': When.CALLBACK}, {'groupless': True}, {'alternative': 'a'}],
)
def test_what_may_be_missing_is_announced(mark: dict[str, object]) -> None:
    static = replace(STATIC, callbacks=(replace(TICK, **mark), ON_JOINT))
    live = replace(LIVE, callbacks=LIVE.callbacks[:1])
    assert [difference.marked for difference in diff([static], [live])] == [True]


@pytest.mark.parametrize(
    ('change', 'fact', 'left', 'right'),
    [
        ({'group': 'arm_default'}, 'group', 'g (REENTRANT)', 'arm_default (EXCLUSIVE default)'),
        ({'key': '/joints'}, 'topic', 'joint_states', '/joints'),
    ],
)
def test_known_facts_that_differ_are_told(
    change: dict[str, object], fact: str, left: str, right: str
) -> None:
    live = replace(LIVE, callbacks=(replace(LIVE.callbacks[0], **change), LIVE.callbacks[1]))
    (difference,) = diff([STATIC], [live])
    told = (difference.kind, difference.fact, difference.left, difference.right)
    assert told == (Kind.DIFFERS, fact, left, right)
    assert not difference.marked


@pytest.mark.parametrize('hertz', [3.0, 15.0, 30.0, 60.0, 120.0])
def test_a_period_that_rclpy_cuts_to_nanoseconds_is_the_same(hertz: float) -> None:
    static, live = (
        replace(STATIC, callbacks=(replace(TICK, period_s=period),))
        for period in (1.0 / hertz, int(1e9 / hertz) / 1e9)
    )
    assert diff([static], [live]) == ()


def test_two_groups_in_place_of_one_are_a_difference() -> None:
    one = replace(STATIC, callbacks=(replace(TICK, group='g'), ON_JOINT), groups=STATIC.groups[1:])
    two = replace(
        one,
        callbacks=(replace(TICK, group='h'), ON_JOINT),
        groups=(*one.groups, CallbackGroup(name='h', type=GroupType.REENTRANT)),
    )
    assert [difference.fact for difference in diff([one], [two])] == ['group']
    assert [difference.fact for difference in diff([two], [one])] == ['group']


def test_thread_counts_differ_unless_one_was_assumed() -> None:
    executor = replace(LIVE.executor, threads=('t0', 't1', 't2'))
    (difference,) = diff([STATIC], [replace(LIVE, executor=executor)])
    assert (difference.fact, difference.left, difference.right) == ('threads', '2', '3')
    assert not difference.marked
    assumed = replace(STATIC.executor, threads_source='default_cpu_count')
    (difference,) = diff([replace(STATIC, executor=assumed)], [replace(LIVE, executor=executor)])
    assert difference.marked


def test_a_unit_that_one_side_lacks_is_told() -> None:
    other = replace(STATIC, name='leg', nodes=('leg',), callbacks=(replace(TICK, node='leg'),))
    (difference,) = diff([STATIC, other], [LIVE])
    assert (difference.kind, difference.fact, difference.subject) == (
        Kind.ONLY_LEFT,
        'unit',
        'leg',
    )


def test_units_pair_by_the_nodes_they_share() -> None:
    other = replace(STATIC, name='leg', nodes=('leg',), callbacks=(replace(TICK, node='leg'),))
    pairs, left, right = match_units([other, STATIC], [LIVE, other])
    assert pairs == [(other, other), (STATIC, LIVE)]
    assert (left, right) == ([], [])


def test_node_started_under_another_name_is_the_same_node() -> None:
    callbacks = tuple(replace(c, node='left_arm') for c in LIVE.callbacks)
    renamed = replace(LIVE, name='left_arm', nodes=('left_arm',), callbacks=callbacks)
    (difference,) = diff([STATIC], [renamed])
    told = (difference.fact, difference.left, difference.right, difference.marked)
    assert told == ('node', 'arm', 'left_arm', True)
    assert merge_units(STATIC, renamed).nodes == ('arm',)
    other = replace(renamed, callbacks=(replace(callbacks[0], function='leg.Leg.kick'),))
    bare = replace(renamed, callbacks=())
    assert match_units([STATIC], [other, bare])[0] == []


def test_merging_fills_what_the_source_does_not_know() -> None:
    static = replace(
        STATIC,
        callbacks=(TICK, replace(ON_JOINT, key=Unknown('a parameter', AT))),
        executor=replace(STATIC.executor, threads_source='default_cpu_count'),
    )
    live = replace(LIVE, rclpy='7.1.6', executor=replace(LIVE.executor, threads=('a', 'b', 'c')))
    merged = merge_units(static, live)
    assert [callback.key for callback in merged.callbacks] == [None, '/joint_states']
    assert merged.executor.threads == ('a', 'b', 'c')
    assert (merged.origin, merged.rclpy, merged.unresolved) == (Origin.MERGED, '7.1.6', ())


def test_merging_adds_what_only_the_run_holds() -> None:
    extra = replace(TICK, function='arm.Arm.late', name='tick', period_s=9.0, group='group_1')
    merged = merge_units(STATIC, replace(LIVE, callbacks=(LIVE.callbacks[0], extra)))
    assert [(c.name, c.group) for c in merged.callbacks] == [
        ('tick', 'arm_default'),
        ('on_joint', 'g'),
        ('tick_2', 'g'),
    ]


def test_merging_is_idempotent() -> None:
    once = merge_units(STATIC, LIVE)
    assert merge_units(once, LIVE) == once


ANY_NUMBER = Unknown('made in a loop', AT)


def test_client_whose_name_only_the_run_knows_is_the_one_made_in_that_line() -> None:
    client = replace(ON_JOINT, name='client', entity=EntityKind.CLIENT, function=None)
    static = replace(STATIC, callbacks=(TICK, replace(client, key=Unknown('a parameter', AT))))
    seen = replace(client, key='lamp/change_state', group='group_1', source=SEEN)
    live = replace(LIVE, callbacks=(TICK, seen))
    (difference,) = diff([static], [live])
    assert (difference.kind, difference.right) == (Kind.NOT_KNOWN, 'lamp/change_state')
    assert difference.marked
    elsewhere = replace(seen, source=Place('arm.py', 13))
    assert len(diff([static], [replace(live, callbacks=(TICK, elsewhere))])) == 2


def test_more_of_what_is_made_any_number_of_times_is_announced() -> None:
    key = Unknown('a parameter', AT)
    static = replace(STATIC, callbacks=(TICK, replace(ON_JOINT, key=key, count=ANY_NUMBER)))
    seen = replace(ON_JOINT, group='group_1', source=SEEN)
    topics = tuple(replace(seen, name=f's_{n}', key=f'joint_{n}') for n in range(3))
    live = replace(LIVE, callbacks=(TICK, *topics))
    assert [difference.marked for difference in diff([static], [live])] == [True, True, True]
    once = replace(static, callbacks=(TICK, replace(ON_JOINT, key=key)))
    assert [difference.marked for difference in diff([once], [live])] == [True, False, False]


def test_class_that_nobody_spins_may_be_missing() -> None:
    executor = replace(STATIC.executor, kind=Unknown('no executor found', AT))
    (difference,) = diff([replace(STATIC, executor=executor)], [])
    assert (difference.kind, difference.marked) == (Kind.ONLY_LEFT, True)
    maybe = tuple(replace(callback, conditional=True) for callback in STATIC.callbacks)
    assert [found.marked for found in diff([replace(STATIC, callbacks=maybe)], [])] == [True]
    mixed = replace(STATIC, callbacks=(maybe[0], ON_JOINT))
    assert [found.marked for found in diff([mixed], [])] == [False]


def test_of_two_programs_with_one_name_of_a_node_that_with_the_same_lines_is_paired() -> None:
    callbacks = tuple(replace(c, source=Place('other.py', 3)) for c in STATIC.callbacks)
    other = replace(STATIC, callbacks=callbacks)
    assert match_units([other, STATIC], [LIVE])[0] == [(STATIC, LIVE)]
    assert match_units([STATIC, other], [LIVE])[0] == [(STATIC, LIVE)]


def nodes_of(names: dict[str, str], unit: Spec) -> Spec:
    """Give a unit nodes with a callback of their class each."""
    callbacks = tuple(
        replace(TICK, name=f'tick_{node}', node=node, function=f'arm.{cls}.tick')
        for node, cls in names.items()
    )
    groups = STATIC.groups[:1]
    return replace(
        unit, name='+'.join(names), nodes=tuple(names), callbacks=callbacks, groups=groups
    )


def test_nodes_renamed_together_are_the_same_nodes() -> None:
    static = nodes_of({'arm': 'Arm', 'leg': 'Leg'}, STATIC)
    live = nodes_of({'leg_0': 'Leg', 'arm_0': 'Arm'}, LIVE)
    (difference,) = diff([static], [live])
    assert (difference.fact, difference.marked) == ('node', True)
    more = nodes_of({'leg_0': 'Leg', 'arm_0': 'Arm', 'arm_1': 'Arm'}, LIVE)
    assert match_units([static], [more])[0] == []
    callbacks = (replace(static.callbacks[0], count=ANY_NUMBER), static.callbacks[1])
    pairs, _, _ = match_units([replace(static, callbacks=callbacks)], [more])
    assert len(pairs) == 1
    assert match_units([static], [nodes_of({'arm_0': 'Arm'}, LIVE)])[0] == []
