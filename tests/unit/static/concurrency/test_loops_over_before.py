"""A callback that is made only behind a loop of its object never enters that loop again."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from std_msgs.msg import Empty
from test_msgs.action import Fibonacci


class Follower(Node):
    def __init__(self):
        super().__init__('follower')
        self.__client = ActionClient(self, Fibonacci, 'follow')
        self.__seen = 0
        self.left = 3
        self.create_subscription(Empty, 'state', self.on_state, 1)

    def on_state(self, msg):
        self.__seen += 1

    def on_goal(self, future):
        goal = future.result()
        goal.get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        self.left -= 1
        if self.left > 0:
            self.send()

    def send(self):
        while self.__seen < 1:
            rclpy.spin_once(self)
        self.__client.send_goal_async(Fibonacci.Goal()).add_done_callback(self.on_goal)


def main():
    rclpy.init()
    follower = Follower()
    follower.send()
    rclpy.spin(follower)


main()
"""
GROWS = 'self.__seen += 1'


def told(*changes: tuple[str, str]) -> list[str]:
    text = PROGRAM
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    found = findings_of(scan_text(text).units, [], [None])
    return sorted({each.code for each in found} & {'CC106', 'CC120'})


@pytest.mark.parametrize(
    'changes',
    [
        [],
        [('while self.__seen < 1', 'while rclpy.ok() and self.__seen <= 2')],
        [('while self.__seen < 1', 'while not self.__seen'), (GROWS, 'self.__seen = True')],
        [('self.__seen < 1', 'self.__seen is None'), (GROWS, 'self.__seen = msg')],
    ],
)
def test_a_loop_that_is_over_for_good_is_not_entered(changes: list[tuple[str, str]]) -> None:
    assert told(*changes) == []


BY_ITSELF = '        sent = self._Follower__client.send_goal_async(Fibonacci.Goal())'
MADE_FIRST = """\
        sent = self.__client.send_goal_async(Fibonacci.Goal())
        sent.add_done_callback(self.on_goal)
        while"""


@pytest.mark.parametrize(
    'changes',
    [
        [(GROWS, 'self.__seen -= 1')],
        [(GROWS, 'self.__seen += len(str(msg))')],
        [('self.left -= 1', 'self.left -= 1; self.__seen = 0')],
        [('while self.__seen < 1', 'while not self.__seen'), (GROWS, 'self.__seen = msg')],
        [('self.__seen < 1', 'self.__seen is None'), (GROWS, 'self.__seen = self.get_name()')],
        # It is left otherwise too.
        [('rclpy.spin_once(self)', 'rclpy.spin_once(self, timeout_sec=1.0); break')],
        # The callback is there before.
        [('        while', MADE_FIRST)],
        # Others come to it.
        [
            (
                'self.left = 3',
                "self.left = 3; self.create_subscription(Empty, 'x', self.on_goal, 1)",
            ),
            ('        goal = future.result()', BY_ITSELF),
            ('goal.get_result_async()', 'sent'),
        ],
        [('self.left = 3', 'self.left = 3; self.create_timer(1.0, self.send)')],
        [
            (
                'self.left = 3',
                "self.left = 3; self.create_subscription(Empty, 'x', self.on_result, 1)",
            )
        ],
        [
            ('self.left = 3', 'self.left = 3; self.create_timer(1.0, self.tick)'),
            ('def on_state', 'def tick(self):\n        self.on_goal(None)\n\n    def on_state'),
        ],
    ],
)
def test_a_loop_that_may_be_entered_again_is_reported(changes: list[tuple[str, str]]) -> None:
    assert told(*changes) != []
