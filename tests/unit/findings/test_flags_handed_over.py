"""A flag that keeps goals out while its holder has done-callbacks of its own."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci

class Sweep(Node):
    def __init__(self):
        super().__init__('sweep')
        self.gate = threading.Lock()
        self.taken = False
        self.rounds = 0
        group = ReentrantCallbackGroup()
        self.light = self.create_client(Trigger, 'light', callback_group=group)
        ActionServer(self, Fibonacci, 'sweep', self.execute, goal_callback=self.ask,
                     callback_group=group)

    def ask(self, goal):
        with self.gate:
            if self.taken:
                return GoalResponse.REJECT
            self.taken = True
        return GoalResponse.ACCEPT

    def execute(self, handle):
        try:
            self.rounds = 0
            self.light.call_async(Trigger.Request()).add_done_callback(self.on_light)
            time.sleep(0.5)
            self.rounds += 1
            time.sleep(0.5)
            handle.succeed()
            return Fibonacci.Result(sequence=[self.rounds])
        finally:
            with self.gate:
                OVER

    def on_light(self, answer):
        ANSWER

    def open(self):
        with self.gate:
            self.taken = False

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Sweep())
executor.spin()
"""


def overlaps(over: str, answer: str) -> list[str]:
    text = PROGRAM.replace('OVER', over).replace('ANSWER', answer)
    return [each.code for each in findings_of(scan_text(text).units, [], [None])]


def test_who_puts_the_flag_down_holds_it_beside_done_callbacks_that_do_not() -> None:
    assert overlaps('self.taken = False', 'print(answer)') == []


@pytest.mark.parametrize('answer', ['self.taken = False', 'self.open()'])
@pytest.mark.parametrize('over', ['self.taken = False', 'pass'])
def test_a_done_callback_that_puts_it_down_ends_the_hold(over: str, answer: str) -> None:
    assert 'CC304' in overlaps(over, answer)
