"""
Stands in for what waits in ``tf2_ros``: the buffer that asks a server by an action.

A look-up sends a goal and waits for an event. Who sets it is the answer, or a thread after the
time-out and a padding; the result is waited for in the same thread. Source: ros2/geometry2
1b005c65, ``tf2_ros_py/tf2_ros/buffer_client.py``.

Runs inside the user's process: the standard library and rclpy only.
"""

from __future__ import annotations

import importlib
import threading
import time
from typing import Any


class TransformException(Exception):  # noqa: N818
    """There is no transform."""


class TimeoutException(TransformException):
    """The server did not answer in time."""


class BufferClient:
    """Asks the server for each transform."""

    def __init__(
        self, node: Any, ns: str, check_frequency: float = 10.0, timeout_padding: Any = None
    ) -> None:
        kind = importlib.import_module('tf2_msgs.action').LookupTransform
        self.node, self._goal = node, kind.Goal
        self.action_client = importlib.import_module('rclpy.action').ActionClient(node, kind, ns)
        self.check_frequency = check_frequency
        self._padding_s = 2.0 if timeout_padding is None else _seconds(timeout_padding)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = None
    ) -> Any:
        """Wait for a transform."""
        return self._ask(timeout)

    def lookup_transform_full(self, *given: Any, timeout: Any = None) -> Any:
        """Wait for a transform between two times."""
        return self._ask(given[5] if len(given) > 5 else timeout)

    def can_transform(self, *given: Any, timeout: Any = None) -> bool:
        """Wait, and say whether there is one."""
        return self._is_there(given[3] if len(given) > 3 else timeout)

    def can_transform_full(self, *given: Any, timeout: Any = None) -> bool:
        """Wait, and say whether there is one."""
        return self._is_there(given[5] if len(given) > 5 else timeout)

    def destroy(self) -> None:
        """Destroy its client."""
        self.action_client.destroy()

    def _is_there(self, timeout: Any) -> bool:
        try:
            self._ask(timeout)
        except TransformException:
            return False
        return True

    def _ask(self, timeout: Any) -> Any:
        if not self.action_client.server_is_ready():
            raise TimeoutException('the server is not ready')
        come = threading.Event()
        sent = self.action_client.send_goal_async(self._goal())
        sent.add_done_callback(lambda _: come.set())
        end = time.monotonic() + self._padding_s + (0.0 if timeout is None else _seconds(timeout))

        def give_up() -> None:
            while not sent.done() and not come.is_set() and time.monotonic() <= end:
                time.sleep(1.0 / self.check_frequency)
            come.set()

        threading.Thread(target=give_up).start()
        come.wait()
        if not sent.done() or not sent.result().accepted:
            raise TimeoutException('no answer in time')
        self.action_client._get_result(sent.result())
        return importlib.import_module('geometry_msgs.msg').TransformStamped()


def _seconds(duration: Any) -> float:
    return float(duration.nanoseconds) / 1e9
