"""Which slices may share their verdicts."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.slices import narrowing
from ros2cc_extract.verify.unit import verify_unit


def subscription(name: str, *blocking: Blocking) -> Callback:
    return Callback(name=name, type=CallbackType.SUB, group=f'{name}_group', blocking=blocking)


def test_a_wait_that_no_model_has_tells_slices_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only of who waits is asked whether it ends; a slice of who does not knows no such query."""
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    wait = Blocking(call='Event.wait', on=Unknown('not followed'))
    callbacks = (subscription('scan'), subscription('stop', wait))
    groups = [CallbackGroup(name=c.group, type=GroupType.EXCLUSIVE) for c in callbacks]
    executor = Executor(name='executor', kind='MultiThreadedExecutor', threads=('one', 'two'))
    unit = Spec(name='arm', callbacks=callbacks, groups=tuple(groups), executor=executor)
    results = verify_unit(close(unit), Options(profile=Profile.RCLPY, structural=False)).results
    assert [r.callbacks for r in results if r.family == 'progress'] == [('stop',)]


@pytest.mark.parametrize('others', [0, 1, 2, 8])
def test_a_guard_condition_overlaps_itself_in_a_unit_of_any_size(others: int) -> None:
    """Triggered once it runs twice: a slice needs a thread for each of these runs."""
    woken = Callback(
        name='woken', type=CallbackType.SUB, entity=EntityKind.GUARD_CONDITION, group='free'
    )
    served = tuple(
        Callback(name=f's{number}', type=CallbackType.SUB, group='g') for number in range(others)
    )
    groups = (
        CallbackGroup(name='free', type=GroupType.REENTRANT),
        CallbackGroup(name='g', type=GroupType.EXCLUSIVE),
    )
    executor = Executor(name='executor', kind='MultiThreadedExecutor', threads=('one', 'two'))
    unit = Spec(name='arm', callbacks=(woken, *served), groups=groups, executor=executor)
    results = verify_unit(close(unit), Options(profile=Profile.RCLPY, structural=False)).results
    told = {r.callbacks: r.verdict for r in results if r.family == 'self_overlap'}
    assert told == {('woken',): Verdict.NOT_SATISFIED} | {
        (callback.name,): Verdict.SATISFIED for callback in served
    }
