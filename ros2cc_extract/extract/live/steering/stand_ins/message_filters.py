"""
Stands in for ``message_filters`` where it is not installed, with what matters for waiting.

It subscribes as the module itself does, and calls what it was given as soon as a set of messages
is whole, with its lock taken, in the thread of the last message. Source:
ros2/message_filters 361e42c7, ``src/message_filters/__init__.py``.

Runs inside the user's process: the standard library only, as nodes are the program's own.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any


class SimpleFilter:
    """Passes messages on to all registered callbacks."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., Any], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:  # noqa: N802
        """Have ``cb`` called with each output, and ``args`` behind it."""
        self.callbacks[len(self.callbacks)] = cb, args
        return len(self.callbacks) - 1

    def signalMessage(self, *messages: Any) -> None:  # noqa: N802
        """Pass an output on."""
        for cb, args in list(self.callbacks.values()):
            cb(*messages, *args)


class Subscriber(SimpleFilter):
    """A subscription whose messages are passed on as they come."""

    def __init__(self, node: Any, kind: Any, topic: str, *args: Any, **named: Any) -> None:
        super().__init__()
        self.node, self.topic = node, topic
        named.setdefault('qos_profile', 10)
        self.sub = node.create_subscription(kind, topic, self.callback, *args, **named)

    def callback(self, message: Any) -> None:
        """Take a message from rclpy."""
        self.signalMessage(message)

    def getTopic(self) -> str:  # noqa: N802
        """Give the name that was asked for."""
        return self.topic


class Cache(SimpleFilter):
    """Keeps the last messages."""

    def __init__(self, f: SimpleFilter, cache_size: int = 1, **_: Any) -> None:
        super().__init__()
        self._kept: deque[Any] = deque(maxlen=cache_size)
        f.registerCallback(self.add)

    def add(self, message: Any) -> None:
        """Keep a message, and pass it on."""
        self._kept.append(message)
        self.signalMessage(message)

    def getLast(self) -> Any:  # noqa: N802
        """Give the newest message, `None` where there was none."""
        return self._kept[-1] if self._kept else None


class TimeSynchronizer(SimpleFilter):
    """Passes on what has come from all inputs with one stamp."""

    slop_ns = 0

    def __init__(self, fs: Sequence[SimpleFilter], queue_size: int, **_: Any) -> None:
        super().__init__()
        self.lock = threading.Lock()
        self._queues: list[deque[Any]] = [deque(maxlen=queue_size) for _ in fs]
        for each, queue in zip(fs, self._queues, strict=True):
            each.registerCallback(self.add, queue)

    def add(self, message: Any, queue: deque[Any]) -> None:
        """Take a message of an input, and look whether a set is whole."""
        with self.lock:
            queue.append(message)
            found = [self._like(message, each) for each in self._queues]
            if all(each is not None for each in found):
                for of_input, each in zip(self._queues, found, strict=True):
                    of_input.remove(each)
                self.signalMessage(*found)

    def _like(self, message: Any, queue: deque[Any]) -> Any:
        at = _stamp_ns(message)
        near = [each for each in queue if abs(_stamp_ns(each) - at) <= self.slop_ns]
        return min(near, key=lambda each: abs(_stamp_ns(each) - at), default=None)


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on what has come from all inputs with stamps not farther apart than ``slop``."""

    def __init__(
        self, fs: Sequence[SimpleFilter], queue_size: int, slop: float, *_: Any, **__: Any
    ) -> None:
        super().__init__(fs, queue_size)
        self.slop_ns = int(slop * 1e9)


def _stamp_ns(message: Any) -> int:
    """When it was made; of a message without a header, or a stand-in, 0."""
    stamp = getattr(getattr(message, 'header', None), 'stamp', None)
    seconds, rest = getattr(stamp, 'sec', 0), getattr(stamp, 'nanosec', 0)
    return int(seconds) * 1_000_000_000 + int(rest)
