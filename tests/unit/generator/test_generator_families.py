"""Families of profile rclpy that the published method lacks, where executions were observed."""

from __future__ import annotations

from dataclasses import replace

import pytest
from generator_units import closed_unit

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import EntityKind, GroupType
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

SINGLE, MULTI, EVENTS = 'SingleThreadedExecutor', 'MultiThreadedExecutor', 'EventsExecutor'
RCLPY = Options(profile=Profile.RCLPY)


def results(unit: ClosedSpec, family: Family) -> list[QueryResult]:
    return [r for r in verify_unit(unit, RCLPY).results if r.family == family.value]


def verdicts(unit: ClosedSpec, family: Family) -> list[bool]:
    return [result.verdict is Verdict.SATISFIED for result in results(unit, family)]


TWO_ARMS = 'left:TMR:a right:TMR:b l:CLT:c r:CLT:d'
ARMS_GROUPS = 'a:EXCLUSIVE b:EXCLUSIVE c:EXCLUSIVE d:EXCLUSIVE'


def arms(threads: int, how: str = '') -> ClosedSpec:
    """As in launch_free_examples/pool_exhaustion: two callbacks call, each by its own client."""
    return closed_unit(TWO_ARMS, ARMS_GROUPS, threads, MULTI, f'left:l{how} right:r{how}')


def test_as_many_callers_as_threads_exhaust_the_pool():
    assert [verdicts(arms(n), Family.POOL_EXHAUSTION) for n in (1, 2, 3)] == [
        [False],
        [False],
        [True],
    ]


def test_whoever_awaits_takes_no_thread_for_ever():
    assert verdicts(arms(1, ':await'), Family.POOL_EXHAUSTION) == []


def test_one_caller_takes_the_only_thread():
    unit = closed_unit('left:TMR:a l:CLT:b', 'a:EXCLUSIVE b:EXCLUSIVE', 1, SINGLE, 'left:l')
    assert verdicts(unit, Family.POOL_EXHAUSTION) == [False]


def with_task(executor: str, threads: int) -> ClosedSpec:
    """A timer in an exclusive group, and a done-callback, which is in none."""
    unit = closed_unit('tick:TMR:g done:CLT:none', 'g:EXCLUSIVE none:REENTRANT', threads, executor)
    tick, done = unit.spec.callbacks
    done = replace(done, entity=EntityKind.DONE_CALLBACK, groupless=True)
    return replace(unit, spec=replace(unit.spec, callbacks=(tick, done)))


def test_no_group_keeps_a_done_callback_from_its_members():
    """Observed: a done-callback and a task overlap with each other and with every timer."""
    (result,) = results(with_task(MULTI, 2), Family.OUTSIDE_GROUPS)
    assert result.verdict is Verdict.NOT_SATISFIED
    assert result.words == 'done, which is in no group, never runs while a member of g does'


def test_one_thread_does():
    assert verdicts(with_task(SINGLE, 1), Family.OUTSIDE_GROUPS) == [True]


@pytest.mark.parametrize(
    ('groups', 'threads', 'executor', 'serial'),
    [
        ('g:EXCLUSIVE h:EXCLUSIVE', 1, SINGLE, True),
        ('g:EXCLUSIVE h:EXCLUSIVE', 1, MULTI, True),
        ('g:EXCLUSIVE h:EXCLUSIVE', 2, MULTI, False),
        ('g:REENTRANT h:REENTRANT', 1, EVENTS, True),
    ],
)
def test_groups_have_an_effect_from_two_threads_on(
    groups: str, threads: int, executor: str, serial: bool
):
    unit = closed_unit('tick:TMR:g scan:SUB:h', groups, threads, executor)
    assert verdicts(unit, Family.SERIAL) == [serial]


def test_threads_have_no_effect_on_one_exclusive_group():
    unit = closed_unit('tick:TMR:g scan:SUB:g', 'g:EXCLUSIVE', 4, MULTI)
    assert verdicts(unit, Family.SERIAL) == [True]


PAPER = 'TMR1:TMR:g TMR2:TMR:g SUB1:SUB:g SUB2:SUB:g'


def starving(unit: ClosedSpec) -> list[str]:
    found = results(unit, Family.STRUCTURAL_STARVATION)
    return [r.callbacks[0] for r in found if r.verdict is Verdict.NOT_SATISFIED]


def test_overload_may_starve_any_of_several_members_and_nobody_else():
    every = ['TMR1', 'TMR2', 'SUB1', 'SUB2']
    exclusive, reentrant = 'g:EXCLUSIVE', 'g:REENTRANT'
    assert starving(closed_unit(PAPER, exclusive, 1, SINGLE)) == []
    assert starving(closed_unit(PAPER, exclusive, 4, MULTI)) == every
    assert starving(closed_unit(PAPER, reentrant, 4, MULTI)) == []


def test_of_two_members_the_first_never_starves():
    assert starving(closed_unit('a:SUB:g b:SUB:g', 'g:EXCLUSIVE', 2, MULTI)) == ['b']
    assert starving(closed_unit('a:SUB:g b:TMR:g', 'g:EXCLUSIVE', 2, MULTI)) == ['a']


def test_rates_stand_beside_what_overload_may_do():
    unit = closed_unit('a:SUB:g b:SUB:g', 'g:EXCLUSIVE', 2, MULTI)
    a, b = unit.spec.callbacks
    busy = replace(a, period_s=1.0, duration_s=1.2)
    spec = replace(unit.spec, callbacks=(busy, replace(b, period_s=2.0, duration_s=0.1)))
    told = results(replace(unit, spec=spec), Family.STRUCTURAL_STARVATION)
    assert [result.load.words for result in told if result.load] == [
        'fine at these rates (load 0.00; about 83% of its arrivals are served)',
        'starved (load 1.20)',
    ]


def test_a_starving_run_is_told_of_the_callback_that_was_asked_for():
    unit = closed_unit('a:SUB:g b:SUB:g x:SUB:h y:SUB:h', 'g:EXCLUSIVE h:EXCLUSIVE', 4, MULTI)
    told = results(unit, Family.STRUCTURAL_STARVATION)[3]
    assert told.verdict is Verdict.NOT_SATISFIED
    assert told.evidence is not None
    assert told.evidence.cycle_from is not None
    said = ' '.join(s.text for moment in told.evidence.moments for s in moment.sentences)
    assert 'data arrives for y' in said
    assert 'y starts' not in said


def test_a_group_type_is_no_matter_of_names():
    unit = closed_unit('a:SUB:g b:SUB:g', 'g:EXCLUSIVE', 2, MULTI)
    (group,) = unit.spec.groups
    opened = replace(unit.spec, groups=(replace(group, type=GroupType.REENTRANT),))
    assert starving(replace(unit, spec=opened)) == []


def test_an_answer_from_outside_is_not_on_its_way_for_ever():
    """A caller holds its group until the answer is there, and then its mates are served."""
    unit = closed_unit(
        'ask:TMR:g mate:SUB:g reply:CLT:h', 'g:EXCLUSIVE h:EXCLUSIVE', 3, MULTI, 'ask:reply'
    )
    assert verdicts(unit, Family.STARVATION) == [True, True, True]
