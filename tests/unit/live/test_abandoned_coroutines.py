"""A coroutine of an executor that was shut down waits for nothing: nobody goes on with it."""

from __future__ import annotations

from collections.abc import Callable, Generator
from types import SimpleNamespace
from typing import Any

import pytest

from ros2cc_extract.extract.live.hang_analysis.probe import _suspended


class Future:
    """As of rclpy."""

    def done(self) -> bool:
        return False

    def __await__(self) -> Generator[None]:
        yield


async def callback(future: Future) -> None:
    await future


async def handler(future: Future) -> None:
    await callback(future)


class Task:
    """As of rclpy, at its first await."""

    def __init__(self, executor: Callable[[], Any]) -> None:
        self._executor = executor
        self._handler = handler(Future())
        self._handler.send(None)

    def done(self) -> bool:
        return False

    def executing(self) -> bool:
        return False


@pytest.mark.parametrize(
    ('executor', 'waits'),
    [
        (SimpleNamespace(_is_shutdown=False), True),
        (SimpleNamespace(), True),
        (SimpleNamespace(_is_shutdown=True), False),
        (None, False),
    ],
)
def test_only_what_an_executor_may_go_on_with_waits(executor: Any, waits: bool) -> None:
    assert (_suspended(Task(lambda: executor), {}) is not None) is waits
