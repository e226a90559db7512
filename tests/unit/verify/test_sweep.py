"""From how many threads on nobody waits forever."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.jobs.pools import Processes
from ros2cc_extract.spec.close import Policy
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.sweep import Sweep, points, run_sweep

EXAMPLES = Path(__file__).parents[3] / 'launch_free_examples'


def unit_of(example: str) -> Spec:
    (unit,) = scan([EXAMPLES / example / 'node.py']).units
    return unit


def sweep(unit: Spec, threads: range, profile: Profile = Profile.RCLPY) -> Sweep:
    options = Options(profile=profile, structural=False)
    return run_sweep(unit, Policy(), options, points(threads, (1,)), Processes(1))


def test_two_arms_need_a_third_thread() -> None:
    """Seen on rclpy: the example hangs on two threads and goes on on three."""
    assert sweep(unit_of('pool_exhaustion'), range(1, 5)).least_threads() == 3


def test_one_thread_is_enough_where_it_is() -> None:
    (fine,) = sweep(unit_of('pool_exhaustion'), range(3, 4)).verifications
    assert Sweep('arms', points([1, 2], [1]), (fine, fine)).least_threads() == 1


def test_no_number_of_threads_mends_a_call_in_the_own_group() -> None:
    assert sweep(unit_of('service_deadlock'), range(1, 4)).least_threads() is None


def test_nothing_is_said_of_what_never_waits() -> None:
    assert sweep(unit_of('two_groups'), range(1, 3)).least_threads() is None


def test_the_published_model_does_not_ask() -> None:
    assert sweep(unit_of('pool_exhaustion'), range(2, 4), Profile.PAPER).least_threads() is None


def test_an_executor_without_a_pool_keeps_its_one_thread_and_says_so() -> None:
    unit = unit_of('default_group_only')
    assert unit.executor.kind == 'SingleThreadedExecutor'
    swept = sweep(unit, range(1, 4))
    assert swept.turns() == ()
    assert len({v.states for v in swept.verifications}) == 1
    note = (
        'SingleThreadedExecutor runs callbacks on one thread, for any number given; to try a '
        'pool, write kind: MultiThreadedExecutor into the specification'
    )
    assert [v.notes for v in swept.verifications] == [(), (note,), (note,)]


def test_on_one_thread_all_may_be_taken_however_many_are_asked() -> None:
    unit = unit_of('service_deadlock')
    alone = replace(unit.executor, kind='SingleThreadedExecutor', threads=('thread_0',))
    swept = sweep(replace(unit, executor=alone), range(1, 4))
    taken = [
        result.verdict
        for verification in swept.verifications
        for result in verification.results
        if result.family == Family.POOL_EXHAUSTION.value
    ]
    assert taken == [Verdict.NOT_SATISFIED] * 3


def test_the_published_model_has_a_pool_whatever_the_executor() -> None:
    swept = sweep(unit_of('default_group_only'), range(1, 3), Profile.PAPER)
    assert swept.verifications[1].notes[-1] == (
        'SingleThreadedExecutor runs callbacks on one thread; the published model has a pool of '
        'as many as asked'
    )
