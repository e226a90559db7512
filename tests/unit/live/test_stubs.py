"""What a program meets where a module is not installed, and what is known of such a module."""

from __future__ import annotations

import contextlib
import json
import sys
from collections.abc import Iterator
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from ros2cc_extract.extract.live.steering.stand_ins import stubs
from ros2cc_extract.extract.live.steering.stand_ins.stub_interfaces import Constant, _kind_over

MISSING = 'no_such_driver_of_ours'


@pytest.fixture
def driver(monkeypatch: pytest.MonkeyPatch) -> Iterator[ModuleType]:
    """A module that nobody has, imported as a program does."""
    monkeypatch.setattr(sys, 'meta_path', [*sys.meta_path, stubs._Finder()])
    monkeypatch.setattr(stubs, 'handed', set())
    yield __import__(MISSING)
    del sys.modules[MISSING]


def at(monkeypatch: pytest.MonkeyPatch, turn: int, *values: object) -> Any:
    """A field of a message at a turn, of a program that compares with such values."""
    monkeypatch.setenv(stubs.VALUES_VARIABLE, json.dumps(values))
    monkeypatch.setattr(stubs, '_turn', lambda: turn)
    return stubs._Field()


def test_exceptions_can_be_caught(driver: ModuleType) -> None:
    """As in ``except (tf2_ros.LookupException, …)``, where something else is raised."""
    with (
        pytest.raises(ZeroDivisionError),
        contextlib.suppress(driver.LookupException, driver.BusError),
    ):
        _ = 1 / 0


def test_what_is_spread_over_names_has_so_many_values(driver: ModuleType) -> None:
    _, _, yaw = driver.angles_of([1.0])
    assert (float(yaw), list(driver.angles_of())) == (0.0, [])


def test_constants_of_an_interface_are_told_apart() -> None:
    kind = _kind_over(object)('Status', (), {})
    assert isinstance(kind.READY, Constant)
    assert kind.READY == kind.READY != kind.RUNNING
    with pytest.raises(AttributeError):
        _ = kind.ready
    with pytest.raises(AttributeError):
        _ = kind._TYPE_SUPPORT


def test_what_has_arrived_is_of_the_type() -> None:
    """It is of the borrowed type, and ``call_async`` asks whether a request is one."""

    class Borrowed:
        pass

    kind = _kind_over(Borrowed)('Borrowed', (Borrowed,), {})
    assert isinstance(Borrowed(), kind)
    assert not isinstance(3, kind)


def test_a_field_is_each_value_in_its_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = [
        (float(at(monkeypatch, turn, 'go', 7)), at(monkeypatch, turn, 'go', 7) == 'go')
        for turn in range(6)
    ]
    assert seen == [(0, False), (7, True), (1, False), (0, True), (7, False), (1, True)]


def test_a_field_is_each_constant_in_its_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    kind = _kind_over(object)('Status', (), {})
    monkeypatch.setattr(stubs, 'constants', lambda: [kind.READY, kind.RUNNING])
    assert at(monkeypatch, 0) == kind.READY
    assert at(monkeypatch, 1) == kind.RUNNING
    assert at(monkeypatch, 1) != kind.READY


def test_a_field_is_true_in_every_other_round(monkeypatch: pytest.MonkeyPatch) -> None:
    assert [bool(at(monkeypatch, turn, 'go')) for turn in range(5)] == [0, 0, 1, 1, 0]


def test_functions_that_it_is_given_are_known(driver: ModuleType) -> None:
    """Types and values are none; the module itself might call functions."""
    motor = driver.Motor('/dev/ttyACM0', int, driver.Mode)
    assert not stubs.handed
    motor.on_data = test_functions_that_it_is_given_are_known
    motor.listen(print)
    assert stubs.handed == {'print', 'test_functions_that_it_is_given_are_known'}


def test_who_inherits_from_it_might_be_called(driver: ModuleType) -> None:
    class Arm(driver.Arm):  # type: ignore[name-defined,misc]
        pass

    assert stubs.handed == {'Arm'}


def test_message_filters_subscribe_and_pass_on_whole_sets(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(sys, 'meta_path', [*sys.meta_path, stubs._Finder()])
    filters = __import__('message_filters')
    made: list[tuple[Any, ...]] = []
    node = SimpleNamespace(
        create_subscription=lambda kind, topic, callback, **more: made.append((callback, more))
    )
    inputs = [filters.Subscriber(node, object, each) for each in ('color', 'depth')]
    seen: list[tuple[Any, ...]] = []
    pairs = filters.ApproximateTimeSynchronizer(inputs, 10, slop=0.1)
    pairs.registerCallback(lambda *messages: seen.append(messages))
    of = SimpleNamespace
    early, near, far = (
        of(header=of(stamp=of(sec=0, nanosec=ns))) for ns in (0, 50_000_000, 900_000_000)
    )
    (color, more), (depth, _) = made
    assert more == {'qos_profile': 10}
    color(early)
    depth(far)
    assert not seen
    depth(near)
    assert seen == [(early, near)]
    del sys.modules['message_filters']
