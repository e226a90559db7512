"""The model judges a snapshot: proven where nothing can end a wait, and only there."""

from __future__ import annotations

from typing import Any

import pytest

from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind
from ros2cc_extract.extract.live.hang_analysis.samples import Entity
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import Standing, Verdict
from ros2cc_extract.hang_proof import judge as judging
from ros2cc_extract.hang_proof.judge import Outcome, judge, judged
from tests.unit.hang_proof.snapshots import POOL, SINGLE, entity, hang, stands

PROVEN, CAN_END = (Outcome.PROVEN, ''), (Outcome.CAN_END, '')
DRIVE, SERVE, CLIENT, OTHER, RATE = 1, 2, 3, 4, 5
LOCK, SECOND_LOCK, EVENT = 71, 72, 73


def call(client_group: int, service_group: int, **drive: Any) -> list[Entity]:
    """A callback in group 10 that calls a service of its own node."""
    return [
        entity(DRIVE, 'timers', 10, **drive),
        entity(SERVE, 'services', service_group, key='/s'),
        entity(CLIENT, 'clients', client_group, key='/s', function=None),
    ]


@pytest.fixture(autouse=True)
def _patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a busy machine the model alone may take longer to be read than a user is to wait."""
    monkeypatch.setattr(judging, 'SECONDS', 60.0)


ASKS = stands(DRIVE, Kind.ANSWER, CLIENT)
AWAITS = stands(DRIVE, Kind.ANSWER, CLIENT, ident=None)


@pytest.mark.parametrize(
    ('entities', 'cls', 'told'),
    [
        (call(10, 10), POOL, PROVEN),
        (call(10, 11), POOL, PROVEN),
        (call(11, 10), POOL, PROVEN),
        (call(11, 11), POOL, CAN_END),
        (call(11, 11), SINGLE, PROVEN),
        (call(11, 11)[::2], POOL, CAN_END),  # the service is of somebody else
    ],
)
def test_call(entities: list[Entity], cls: str, told: object) -> None:
    assert judge(hang(entities, ASKS, cls=cls)) == told


@pytest.mark.parametrize(
    ('client_group', 'cls', 'told'),
    [(10, POOL, PROVEN), (10, SINGLE, PROVEN), (11, POOL, CAN_END), (11, SINGLE, CAN_END)],
)
def test_await(client_group: int, cls: str, told: object) -> None:
    assert judge(hang(call(client_group, 11), AWAITS, cls=cls)) == told


@pytest.mark.parametrize(('workers', 'told'), [(2, PROVEN), (3, CAN_END)])
def test_pool_that_is_filled_by_runs_of_one_callback(workers: int, told: object) -> None:
    entities = call(11, 11, exclusive=False)
    assert judge(hang(entities, ASKS, ASKS, workers=workers)) == told


@pytest.mark.parametrize(
    ('group', 'cls', 'given', 'told'),
    [
        (10, POOL, {}, PROVEN),
        (11, POOL, {}, CAN_END),
        (11, SINGLE, {}, PROVEN),
        (11, POOL, {'module': 'rclpy.parameter_service'}, PROVEN),  # runs nothing of the program
    ],
)
def test_event_that_any_callback_may_set(
    group: int, cls: str, given: dict[str, Any], told: object
) -> None:
    entities = [entity(DRIVE, 'timers', 10), entity(OTHER, 'subscriptions', group, **given)]
    waits = stands(DRIVE, Kind.EVENT, EVENT)
    assert judge(hang(entities, waits, cls=cls)) == told


def test_event_that_another_run_of_the_callback_may_set() -> None:
    entities = [entity(DRIVE, 'timers', 10, exclusive=False)]
    waits = stands(DRIVE, Kind.EVENT, EVENT)
    assert judge(hang(entities, waits, workers=2)) == CAN_END
    assert judge(hang(entities, waits, waits, workers=2)) == PROVEN


@pytest.mark.parametrize(
    ('group', 'cls', 'told'), [(10, POOL, PROVEN), (11, POOL, CAN_END), (11, SINGLE, PROVEN)]
)
def test_rate(group: int, cls: str, told: object) -> None:
    entities = [
        entity(DRIVE, 'subscriptions', 10),
        entity(RATE, 'timers', group, module='rclpy.timer'),
    ]
    assert judge(hang(entities, stands(DRIVE, Kind.RATE, RATE), cls=cls)) == told


def test_locks_in_a_circle() -> None:
    entities = [entity(number, 'timers', number, exclusive=False) for number in (DRIVE, OTHER)]
    one = stands(DRIVE, Kind.LOCK, SECOND_LOCK, ident=100)
    other = stands(OTHER, Kind.LOCK, LOCK, ident=200)
    objects = {LOCK: {'owner': 100}, SECOND_LOCK: {'owner': 200}}
    assert judge(hang(entities, one, other, objects=objects)) == PROVEN
    told = judge(hang(entities, one, objects=objects))
    assert told == (Outcome.NOT_PROVEN, 'no callback that waits holds the lock')


def test_lock_whose_holder_waits_for_what_comes() -> None:
    entities = [*call(11, 11), entity(OTHER, 'timers', 12)]
    waits = stands(OTHER, Kind.LOCK, LOCK, ident=200)
    objects = {LOCK: {'owner': 100}}
    assert judge(hang(entities, ASKS, waits, workers=3, objects=objects)) == CAN_END
    assert judge(hang(entities, ASKS, waits, workers=2, objects=objects)) == PROVEN


@pytest.mark.parametrize(
    ('standing', 'given', 'reason'),
    [
        (stands(None, Kind.ANSWER, CLIENT), {}, 't waits outside of callbacks'),
        (stands(99, Kind.ANSWER, CLIENT), {}, 'a callback that waits is of no executor'),
        (stands(DRIVE, Kind.JOIN, 5), {}, 'the model has no wait for the end of a thread'),
        (stands(DRIVE, Kind.ANSWER, 99), {}, 'a client is served by another executor, or by none'),
        (ASKS, {'cls': 'OwnExecutor'}, 'the model does not have OwnExecutor'),
    ],
)
def test_what_the_model_has_no_word_for(
    standing: Standing, given: dict[str, Any], reason: str
) -> None:
    assert judge(hang(call(10, 10), standing, **given)) == (Outcome.NOT_PROVEN, reason)


def test_state_that_the_model_does_not_come_to() -> None:
    """Two runs of one exclusive group: whatever that is, the model knows nothing of it."""
    told = judge(hang(call(10, 10), ASKS, ASKS))
    assert told == (Outcome.NOT_PROVEN, 'the model does not come to this state')


def test_search_that_takes_too_long_proves_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(judging, 'SECONDS', 0.0)
    outcome, reason = judge(hang(call(10, 10), ASKS))
    assert outcome is Outcome.NOT_PROVEN
    assert '0 s' in reason


def test_the_verdict_says_what_it_rests_on() -> None:
    proven = judged(hang(call(10, 10), ASKS))
    assert (proven.verdict, proven.proof) == (Verdict.DEADLOCK, 'proven by the model')
    refuted = judged(hang(call(11, 11), ASKS))
    assert (refuted.verdict, refuted.proof) == (
        Verdict.UNDECIDED,
        'a deadlock by the wait-for graph, but in the model a wait can end',
    )
    open_ = judged(hang(call(10, 10), stands(DRIVE, Kind.JOIN, 5)))
    assert (open_.verdict, open_.proof) == (
        Verdict.DEADLOCK,
        'by the wait-for graph; not proven by the model: the model has no wait for the end of a '
        'thread',
    )
