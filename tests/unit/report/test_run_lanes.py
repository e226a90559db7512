"""A run cut into lanes: who acts, in which location he stays, and for which callback."""

from __future__ import annotations

from ros2cc_extract.report.shared.run_lanes import Stay, lanes_of
from ros2cc_extract.verify.results.evidence import Evidence, Moment, Sentence

START = {
    'executor': 'wait',
    'thread_0': 'idle',
    'thread_1': 'idle',
    'group': 'open',
    'tick': 'off',
}


def moment(number: int, lane: str, text: str, **changes: int | str) -> Moment:
    return Moment(number=number, sentences=(Sentence(lane, text),), places=(), changes=changes)


def lanes(*moments: Moment) -> dict[str, tuple[Stay, ...]]:
    run = Evidence(start=START, moments=moments, cycle_from=None, ends=None)
    return {lane.process: lane.stays for lane in lanes_of(run, ['tick', 'tock'])}


def test_who_acts_or_moves_has_a_lane_in_the_order_of_the_model() -> None:
    found = lanes(
        moment(1, 'thread_0', 'thread_0 begins', group='closed'),
        moment(2, 'tick', 'tick is due'),
    )
    assert list(found) == ['thread_0', 'group', 'tick']
    assert found['tick'] == (Stay('off', 0, 3, None, True),)
    assert found['group'] == (Stay('open', 0, 1, None, True), Stay('closed', 1, 3, None, False))


def test_a_stay_names_the_callback_that_is_told_with_its_process() -> None:
    found = lanes(
        moment(1, 'executor', 'executor hands tick to thread_0', executor='serve', thread_0='has'),
        moment(2, 'thread_0', 'tock starts', thread_0='runs'),
        moment(3, 'executor', 'executor polls', thread_0='runs', executor='wait', n=3),
        moment(4, 'thread_0', 'tock ends', thread_0='idle'),
    )
    assert found['thread_0'] == (
        Stay('idle', 0, 1, None, True),
        Stay('has', 1, 2, 'tick', False),
        Stay('runs', 2, 4, 'tock', False),
        Stay('idle', 4, 5, None, True),
    )
    assert found['executor'] == (
        Stay('wait', 0, 1, None, True),
        Stay('serve', 1, 3, 'tick', False),
        Stay('wait', 3, 5, None, True),
    )


def test_of_others_a_stay_names_nobody() -> None:
    found = lanes(moment(1, 'executor', 'executor hands tick to thread_0', thread_1='has'))
    assert found['thread_1'][1] == Stay('has', 1, 2, None, False)


def test_nobody_acts_in_a_run_without_steps() -> None:
    run = Evidence(start=START, moments=(), cycle_from=None, ends=None)
    assert lanes_of(run, ['tick']) == ()
