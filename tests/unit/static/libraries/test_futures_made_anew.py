"""An attribute holds a future from the start, and a callback puts another one there to await."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

class Lift(Node):
    def __init__(self):
        super().__init__('lift')
        self.arrived = MADE
        side = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Int32, 'floor', self.on_floor, 10)
        self.create_service(Trigger, 'go', self.go, callback_group=side)

    def on_floor(self, msg):
        self.arrived.SETS

    async def go(self, request, response):
        self.arrived = MADE
        WAITS
        return response

rclpy.init()
executor = MultiThreadedExecutor(2)
executor.add_node(Lift())
executor.spin()
"""


@pytest.mark.parametrize(
    ('made', 'sets', 'waits'),
    [
        ('Future()', 'set_result(msg.data)', 'await self.arrived'),
        ('threading.Event()', 'set()', 'self.arrived.wait()'),
    ],
)
def test_who_sets_the_one_sets_the_other(made: str, sets: str, waits: str) -> None:
    text = PROGRAM.replace('MADE', made).replace('SETS', sets).replace('WAITS', waits)
    found = scan_text(text)
    (unit,) = found.units
    go = next(each for each in unit.callbacks if each.name == 'go')
    assert [[waker.by for waker in block.wakers] for block in go.blocking] == [['on_floor']]
    assert found.diagnostics == ()
