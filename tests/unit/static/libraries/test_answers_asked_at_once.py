"""The result of a request that a callback has just sent is None: nothing has waited for it."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import plant
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'ask')
        self.mover = ActionClient(self, Fibonacci, 'move')
        self.create_timer(0.5, self.work)

    {is_async}def work(self):
        future = {request}
        {then}


rclpy.init()
rclpy.spin(Asker())
"""
CALL = 'self.client.call_async(Trigger.Request())'
GOAL = 'self.mover.send_goal_async(Fibonacci.Goal())'


def asked(then: str, request: str = CALL, is_async: str = '') -> list[int]:
    text = PROGRAM.format(then=then, request=request, is_async=is_async)
    found = scan_text(text).diagnostics
    return [each.place.line for each in found if each.slug == 'lost-task']


@pytest.mark.parametrize('request_', [CALL, GOAL])
def test_it_is_reported_where_it_is_asked_for(request_: str) -> None:
    assert asked('print(future.result())', request_) == [18]


@pytest.mark.parametrize(
    ('then', 'is_async'),
    [
        ('rclpy.spin_until_future_complete(self, future)\n        print(future.result())', ''),
        ('if future.done():\n            print(future.result())', ''),
        ('if not future.done():\n            return\n        print(future.result())', ''),
        ('future.add_done_callback(lambda done: print(future.result(), done.result()))', ''),
        ('await future\n        print(future.result())', 'async '),
        ('plant.wait(future)\n        print(future.result())', ''),
    ],
)
def test_what_was_waited_for_is_there(then: str, is_async: str) -> None:
    assert asked(then, is_async=is_async) == []
