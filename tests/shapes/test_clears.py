"""An event that is cleared behind the request whose answer sets it may be wiped out."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.answered = threading.Event()
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'ask', callback_group=group)
        self.create_timer(1.0, self.tick)

    def tick(self):
        {first}
        {second}
        self.answered.wait()

    def on_answer(self, future):
        self.answered.set()

rclpy.init()
executor = MultiThreadedExecutor(3)
executor.add_node(Asker())
executor.spin()
"""
CLEARS = 'self.answered.clear()'
ASKS = 'self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)'


@pytest.mark.parametrize(
    ('first', 'second', 'is_open'), [(CLEARS, ASKS, False), (ASKS, CLEARS, True)]
)
def test_the_order_of_clear_and_request(first: str, second: str, is_open: bool) -> None:
    (unit,) = scan_text(PROGRAM.format(first=first, second=second)).units
    (tick,) = [each for each in unit.callbacks if each.name == 'tick']
    (wait,) = tick.blocking
    assert (wait.escapes is not None) is is_open
