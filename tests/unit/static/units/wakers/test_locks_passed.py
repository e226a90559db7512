"""A callback that takes a lock, gives it back, and then ends the wait of who holds the lock."""

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


class Keeper(Node):
    def __init__(self):
        super().__init__('keeper')
        self.lock = threading.Lock()
        self.confirmed = threading.Event()
        self.slots = []
        other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Empty, 'confirm', self.on_confirm, 1, callback_group=other)
        self.create_timer(0.2, self.work)

    def on_confirm(self, msg):
        {confirm}

    def work(self):
        {work}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Keeper())
executor.spin()
"""
HOLDS = """with self.lock:
            self.confirmed.wait()"""
FREES = """with self.lock:
            self.slots.clear()
        self.confirmed.wait()"""
TAKES = """with self.lock:
            self.slots.append(msg)
        self.confirmed.set()"""
MAY_TAKE = """if self.count_publishers('x'):
            with self.lock:
                self.slots.append(msg)
        self.confirmed.set()"""
TRIES = """if self.lock.acquire(timeout=0.1):
            self.slots.append(msg)
            self.lock.release()
        self.confirmed.set()"""


@pytest.mark.parametrize(
    ('confirm', 'work', 'verdict'),
    [
        (TAKES, HOLDS, FOUND),
        (TAKES, FREES, ENDS),
        (MAY_TAKE, HOLDS, UNDECIDED),
        (TRIES, HOLDS, ENDS),
        ('self.confirmed.set()', HOLDS, ENDS),
    ],
)
def test_who_must_take_the_lock_before(confirm: str, work: str, verdict: str) -> None:
    assert judge(PROGRAM.format(confirm=confirm, work=work))['work'] == verdict
