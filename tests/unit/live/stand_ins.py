"""As much of rclpy's classes as is wrapped; the tests of ``tests/live`` wrap the real ones."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

from ros2cc_extract.extract.live.hook.groups import reporting
from ros2cc_extract.extract.live.recorder.events import BEGIN, REFUSED
from ros2cc_extract.extract.live.recorder.record import Recorder

Told = Callable[[], list[tuple[str, int]]]


Replace = Callable[[type, str, Any], None]


class Entities:
    """A group of theirs."""


class Entity:
    """As much of an entity as is looked at."""

    callback: Any = None

    def __init__(self, group: Any = None) -> None:
        self.callback_group = group or Entities()


class Broken:
    """A record without a number."""


def wrap(recorder: Recorder, group: Any) -> None:
    name = 'beginning_execution'
    setattr(group, name, reporting(recorder, group, name, BEGIN, REFUSED))


class Handler:
    """A task as rclpy makes one: runs once, lets go of its handler when it is done."""

    def __init__(self, handler: Any, taken: Any = None) -> None:
        self._handler = handler
        self._taken = taken
        self._done = False

    def executing(self) -> bool:
        return False

    def done(self) -> bool:
        return self._done

    def __call__(self) -> Any:
        try:
            if inspect.iscoroutine(self._handler):
                try:
                    return self._handler.send(None)
                except StopIteration:
                    self._done, self._handler = True, None
                    return None
            result = self._handler()
            self._done, self._handler = True, None
            return result
        except ZeroDivisionError:
            self._done, self._handler = True, None
            raise


class Executor:
    """Makes handlers as rclpy's executor does."""

    task_class: Any = Handler
    mark_raises: Any = None

    def _make_handler(self, entity: Any, node: Any, take: Any, *more: Any) -> Handler:
        if entity is None:
            raise ValueError('no entity')
        task = self.task_class(lambda: (take(entity), more))
        task.mark_raises = self.mark_raises
        return task


class Pause:
    """Awaited, gives its thread back once."""

    def __await__(self) -> Iterator[None]:
        yield


class WaitSet:
    """Gives what it was given."""

    def wait(self, timeout: Any) -> Any:
        if timeout is None:
            raise OSError('interrupted')
        return timeout


class Waiting:
    """An executor that waits in a generator, as rclpy's do."""

    wait_set: Any = WaitSet()

    def _wait_for_ready_callbacks(self, timeout: Any) -> Iterator[Any]:
        yield self.wait_set.wait(timeout)

    def wait_for_ready_callbacks(self, timeout: Any) -> Any:
        return next(self._wait_for_ready_callbacks(timeout))


RCLPY = SimpleNamespace(Executor=Waiting, _rclpy=SimpleNamespace(WaitSet=WaitSet))
