"""Loops of asyncio that sleep although something is ready."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from ros2cc_extract.extract.live.steering.loops import asleep

SLEEPS_S = 0.2
Hand = Callable[[asyncio.AbstractEventLoop, Callable[[], Any]], object]


@pytest.fixture
def loop() -> Iterator[tuple[asyncio.AbstractEventLoop, threading.Thread]]:
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever)
    thread.start()
    time.sleep(SLEEPS_S)
    yield loop, thread
    loop.call_soon_threadsafe(loop.stop)
    thread.join()
    loop.close()


@pytest.mark.parametrize(
    ('hand', 'sleeps'),
    [
        (lambda loop, act: loop.call_soon(act), True),
        (lambda loop, act: loop.call_soon_threadsafe(act), False),
        (lambda _, act: act(), False),
    ],
)
def test_what_does_not_wake_a_loop_is_ready_while_it_sleeps(
    hand: Hand, sleeps: bool, loop: tuple[asyncio.AbstractEventLoop, threading.Thread]
) -> None:
    hand(loop[0], lambda: None)
    time.sleep(SLEEPS_S)
    looks = [asleep() for _ in range(2)]
    assert looks[0] == looks[1]
    expected = [(loop[1].ident, id(loop[0]))] if sleeps else []
    assert [(each['thread'], each['loop']) for each in looks[0]] == expected
