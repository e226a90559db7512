"""A recorded run that had not ended is no run that ends."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Measured,
    Spec,
)
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

ENDS = {'deadlock', 'starvation', 'progress', 'pool_exhaustion'}


def unit(running: int, *blocking: Blocking, others: int = 1) -> ClosedSpec:
    timer = Callback(
        name='tick',
        type=CallbackType.TMR,
        entity=EntityKind.TIMER,
        group='g',
        blocking=blocking,
        measured=Measured(count=1, running=running),
    )
    scans = tuple(
        Callback(name=f'scan{number}', type=CallbackType.SUB, group='g')
        for number in range(others)
    )
    return close(
        Spec(
            name='unit',
            callbacks=(timer, *scans),
            groups=(CallbackGroup(name='g', type=GroupType.EXCLUSIVE),),
            executor=Executor(
                name='executor', kind='MultiThreadedExecutor', threads=('one', 'two')
            ),
        )
    )


def undecided(closed: ClosedSpec, profile: Profile) -> dict[str | None, str | None]:
    found = verify_unit(closed, Options(profile=profile, structural=False)).results
    return {r.family: r.reason for r in found if r.verdict is Verdict.UNDECIDED}


REASON = 'the model leaves out what held tick, which had not ended when it was recorded'


@pytest.mark.parametrize('others', [1, 9])
def test_a_run_that_nothing_explains_leaves_open_whether_anybody_comes_to_an_end(
    others: int,
) -> None:
    found = undecided(unit(1, others=others), Profile.RCLPY)
    assert found == dict.fromkeys(('deadlock', 'starvation', 'progress'), REASON)


def test_the_published_model_knows_no_run_without_an_end_either() -> None:
    assert undecided(unit(1), Profile.PAPER)['deadlock'] == REASON


@pytest.mark.parametrize('profile', list(Profile))
def test_runs_that_ended_and_runs_in_a_known_wait_leave_nothing_open(profile: Profile) -> None:
    slept = Blocking(call='time.sleep', seconds=1.0)
    assert undecided(unit(0), profile) == {}
    assert undecided(unit(1, slept), profile) == {}


def test_a_spec_with_such_a_run_stays_what_it_is_without_measurements() -> None:
    closed = unit(1)
    tick, *others = closed.spec.callbacks
    plain = replace(closed.spec, callbacks=(replace(tick, measured=None), *others))
    assert undecided(replace(closed, spec=plain), Profile.RCLPY) == {}
