"""What the executor written in C++ reads from an entity, however a release keeps it there."""

from __future__ import annotations

import operator
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from ros2cc_extract.extract.live.hook.events_executor import mark_spinning, measure_callbacks
from ros2cc_extract.extract.live.hook.wrapping import Hook
from ros2cc_extract.extract.live.recorder.record import Recorder
from tests.unit.live.stand_ins import Entities, Replace, Told


class Plain:
    """Keeps its callback in the instance: a timer, a service."""

    kind = 'one argument'

    def __init__(self, callback: Callable[..., Any]) -> None:
        self.callback_group = Entities()
        self.callback = callback


class Looking(Plain):
    """Looks at a callback when it gets it: a subscription."""

    @property
    def callback(self) -> Any:
        """The callback, which decides how it is called."""
        return self._callback

    @callback.setter
    def callback(self, value: Any) -> None:
        self.kind = f'{value.__code__.co_argcount} arguments'
        self._callback = value


class Inheriting(Looking):
    """Has the property from its base, as a subscription has since 10.0."""


class Slotted(Plain):
    """Keeps its callback in a slot."""

    __slots__ = ('callback',)


class Events:
    """Reads a callback and calls it from C, without a frame of its own."""

    spin = operator.attrgetter('entity.callback')

    def __init__(self, entity: Any) -> None:
        self.entity = entity


def work(_message: str, _info: str) -> None:
    """Do nothing."""


@pytest.mark.parametrize('entity_class', [Plain, Looking, Inheriting, Slotted])
def test_callback_is_measured_wherever_it_is_kept(
    recorder: Recorder, told: Told, replaced: Replace, entity_class: Any
) -> None:
    replaced(Events, 'spin', Events.spin)
    mark_spinning(Events, replaced)
    kind = entity_class(work).kind
    measure_callbacks(recorder, entity_class, replaced)
    entity = entity_class(work)
    assert (entity.kind, entity.callback) == (kind, work)
    Events.spin(Events(entity))('hello', 'info')
    (record,) = recorder.entities.values()
    assert told() == [('begin', record.number), ('end', record.number)]
    assert recorder.loss_count == 0


@pytest.mark.parametrize('entity_class', [Plain, Looking, Inheriting, Slotted])
def test_callback_that_is_not_there_is_told_as_ever(
    recorder: Recorder, replaced: Replace, entity_class: Any
) -> None:
    measure_callbacks(recorder, entity_class, replaced)
    assert getattr(entity_class.__new__(entity_class), 'callback', None) is None


def test_what_a_release_lacks_is_counted_and_the_rest_wrapped(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    class Executor:
        """Has nothing of what is wrapped."""

    class CallbackGroup:
        """Is as ever."""

        def add_entity(self, entity: Any) -> str:
            """Take an entity in."""
            return f'{entity} taken in'

    groups = SimpleNamespace(CallbackGroup=CallbackGroup)
    monkeypatch.setitem(sys.modules, 'rclpy.callback_groups', groups)
    hook = Hook(str(tmp_path), traced=True)
    assert not hook.wrap(SimpleNamespace(Executor=Executor))
    assert CallbackGroup().add_entity('timer') == 'timer taken in'
    assert len(hook.recorder.all_groups) == 1
    hook.unwrap()
