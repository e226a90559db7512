"""A service that a callback makes is there when that callback has run."""

from __future__ import annotations

import pytest

from tests.random_waits.suite import ENDS, FOUND, judge

PROGRAM = """\
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        other = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'capture', callback_group=other)
        {early}
        self.starting = self.create_timer(0.5, self.start, callback_group={group})
        self.create_timer(0.2, self.work)

    def start(self):
        self.starting.cancel()
        self.server = self.create_service(Trigger, 'capture', self.on_capture)

    def on_capture(self, request, response):
        return response

    def work(self):
        while not self.client.wait_for_service(timeout_sec=1.0):
            print('not there')


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Camera())
executor.spin()
"""
EARLY = "self.first = self.create_service(Trigger, 'capture', self.on_capture)"


@pytest.mark.parametrize(('group', 'verdict'), [('other', ENDS), ('None', FOUND)])
def test_it_is_waited_for_until_that_has_run(group: str, verdict: str) -> None:
    assert judge(PROGRAM.format(group=group, early='pass'))['work'] == verdict


def test_one_that_the_set_up_makes_is_there() -> None:
    assert judge(PROGRAM.format(group='None', early=EARLY)).get('work') != FOUND
