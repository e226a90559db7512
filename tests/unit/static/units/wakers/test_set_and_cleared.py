"""An event that the set-up sets and a callback clears ends a wait only where others set it."""

from __future__ import annotations

import pytest

from tests.random_waits.suite import ENDS, FOUND, UNDECIDED, judge

PROGRAM = """\
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Worker(Node):
    def __init__(self):
        super().__init__('worker')
        self.may_go = threading.Event()
        self.may_go.set()
        other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Empty, 'pause', self.on_pause, 1, callback_group=other)
        self.create_subscription(Empty, 'resume', self.on_resume, 1, callback_group={group})
        self.create_timer(0.2, self.work)

    def on_pause(self, msg):
        {clears}

    def on_resume(self, msg):
        self.may_go.set()

    def work(self):
        self.may_go.wait()


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Worker())
executor.spin()
"""
CLEARS = 'self.may_go.clear()'


@pytest.mark.parametrize(
    ('group', 'clears', 'verdict'),
    [
        ('other', CLEARS, ENDS),
        ('None', CLEARS, FOUND),
        ('None', f'if msg: {CLEARS}', UNDECIDED),
        ('None', f'{CLEARS}; self.may_go.set()', ENDS),
    ],
)
def test_who_clears_it_may_come_before_the_wait(group: str, clears: str, verdict: str) -> None:
    assert judge(PROGRAM.format(group=group, clears=clears))['work'] == verdict
