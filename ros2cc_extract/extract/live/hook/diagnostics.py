"""
What the watch has found, on ``/diagnostics`` (REP 107), once a second.

Runs inside the user's process, in the thread that writes the recording: the standard library,
and what the process has loaded of rclpy. The publisher is one more of a node of the program: a
node of our own would be in its graph, with services that nothing serves.
"""

from __future__ import annotations

import importlib
import os
import socket
import sys
import time
from typing import Any

from ..recorder.record import Recorder

VARIABLE = 'ROS2CC_LIVE_DIAGNOSTICS'
TOPIC = '/diagnostics'
EVERY_S = 1.0
DEPTH = 10
HEALTHY = 'callbacks begin and end'
# The verdict of ``why`` that nothing can end; the others may pass.
_FOREVER = 'deadlock'


class Diagnostics:
    """Publishes one status for this process as long as one of its nodes lives."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self.forget()

    def forget(self) -> None:
        """Begin anew, as a forked child must."""
        self._node: Any = None
        self._publisher: Any = None
        self._not_before = 0.0
        self._usable = True

    def update(self, found: tuple[str, str] | None) -> None:
        """
        Publish, if it is time.

        :param found: the verdict and the explanation of a standstill that goes on.
        """
        now = time.monotonic()
        if not self._usable or now < self._not_before:
            return
        self._not_before = now + EVERY_S
        try:
            messages = importlib.import_module('diagnostic_msgs.msg')
        except ImportError:
            self._usable = False
            print(
                'ros2cc-extract: nothing is published on /diagnostics: this interpreter has no '
                'diagnostic_msgs\n',
                end='',
                file=sys.stderr,
            )
            return
        if self._is_ready(messages):
            self._publisher.publish(self._message(messages, found))

    def _is_ready(self, messages: Any) -> bool:
        """Whether a living node publishes for us; another one does when that is destroyed."""
        if self._node is None or not _is_alive(self._node):
            living = (record.ref() for record in list(self._recorder.all_nodes))
            self._node = next((node for node in living if node and _is_alive(node)), None)
            if self._node is not None:
                self._publisher = self._publish_by(self._node, messages)
        return self._node is not None

    @staticmethod
    def _publish_by(node: Any, messages: Any) -> Any:
        # By default rclpy makes an entity for events of quality of service, which some thread
        # would have to serve.
        events = importlib.import_module('rclpy.event_handler').PublisherEventCallbacks
        silent = events(use_default_callbacks=False)
        return node.create_publisher(
            messages.DiagnosticArray, TOPIC, DEPTH, event_callbacks=silent
        )

    def _message(self, messages: Any, found: tuple[str, str] | None) -> Any:
        status = messages.DiagnosticStatus
        verdict, text = found or ('', '')
        level = status.ERROR if verdict == _FOREVER else status.WARN if found else status.OK
        values = {'process': str(os.getpid()), **({'explanation': text} if found else {})}
        message = messages.DiagnosticArray()
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.status = [
            status(
                level=level,
                name=f'{self._node.get_fully_qualified_name()}: callbacks',
                message=verdict or HEALTHY,
                hardware_id=socket.gethostname(),
                values=[messages.KeyValue(key=key, value=text) for key, text in values.items()],
            )
        ]
        return message


def _is_alive(node: Any) -> bool:
    try:
        with node.handle:
            return bool(node.context.ok())
    except Exception:  # a destroyed one raises InvalidHandle, which cannot be imported here
        return False
