"""Of a program that is alone nobody asks the services or sends on the topic."""

from __future__ import annotations

import pytest

from tests.random_waits.suite import ENDS, FOUND, UNDECIDED, judge

PROGRAM = """\
import threading
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.free = ReentrantCallbackGroup()
        self.given = threading.Event()
        self.create_service(Trigger, 'give', self.serve_0, callback_group=self.free)
        self.client_0 = self.create_client(Trigger, 'give', callback_group=self.free)
        self.create_timer(0.1, self.tick_0)
        self.create_timer(0.1, self.tick_1, callback_group=self.free)

    def serve_0(self, request, response):
        self.given.set()
        return response

    def tick_0(self):
        self.given.wait()

    def tick_1(self):
        {asks}


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=8)
    executor.add_node(Waiter())
    executor.spin()
"""


@pytest.mark.parametrize(
    ('asks', 'expected'),
    [('pass', FOUND), ('self.client_0.call_async(Trigger.Request())', ENDS)],
)
def test_a_service_that_nobody_asks_ends_no_wait(asks: str, expected: str) -> None:
    assert judge(PROGRAM.format(asks=asks))['tick_0'] == expected


TOLD = PROGRAM.replace('self.given = threading.Event()', 'self.given = threading.Condition()')
TOLD = TOLD.replace('self.given.set()', 'with self.given:\n            self.given.notify_all()')
TOLD = TOLD.replace('self.given.wait()', 'with self.given:\n            self.given.wait()')
ASKS = 'self.client_0.call_async(Trigger.Request())'


@pytest.mark.parametrize(
    ('group', 'expected'), [('', UNDECIDED), (', callback_group=self.free', ENDS)]
)
def test_a_service_ends_no_wait_of_who_keeps_out_whoever_asks(group: str, expected: str) -> None:
    text = TOLD.replace('self.tick_1, callback_group=self.free', f'self.tick_1{group}')
    assert judge(text.format(asks=ASKS))['tick_0'] == expected
