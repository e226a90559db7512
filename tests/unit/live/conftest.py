"""Recorders with wrappers in Python and in C, and what is wrapped for them."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from typing import Any

import pytest

from ros2cc_extract.extract.live.hook import groups, steps
from ros2cc_extract.extract.live.recorder import journal
from ros2cc_extract.extract.live.recorder.events import EVENT_NAMES, rows
from ros2cc_extract.extract.live.recorder.record import Recorder
from tests.unit.live.stand_ins import Replace, Told, wrap


@pytest.fixture(autouse=True)
def _only_what_the_test_makes_is_collected() -> Iterator[None]:
    """A run of many tests has millions of objects, and to look at all of them takes a second."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


@pytest.fixture(params=['plain', 'native'])
def recorder(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Recorder:
    """Give a recorder whose wrappers are in Python or in C."""
    if request.param == 'plain':
        for module in (groups, journal, steps):
            monkeypatch.setattr(module, 'native', None)
    return Recorder(traced=True)


@pytest.fixture
def told(recorder: Recorder) -> Told:
    def tell() -> list[tuple[str, int]]:
        fields = (fields for fields, _ in rows(recorder.take_events()))
        return [(EVENT_NAMES[what], number) for _, _, what, number in fields]

    return tell


@pytest.fixture
def group_class(recorder: Recorder) -> type:
    class Group:
        """A callback group."""

        answer: Any = True

        def beginning_execution(self, entity: Any) -> Any:
            """Say whether it may begin."""
            if isinstance(self.answer, BaseException):
                raise self.answer
            return self.answer

    wrap(recorder, Group)
    return Group


@pytest.fixture
def replaced() -> Iterator[Replace]:
    """Replace attributes of classes, until the test has ended."""
    kept: list[tuple[type, str, Any]] = []

    def replace(owner: type, name: str, value: Any) -> None:
        kept.append((owner, name, owner.__dict__.get(name)))
        setattr(owner, name, value)

    yield replace
    for owner, name, value in reversed(kept):
        delattr(owner, name) if value is None else setattr(owner, name, value)
