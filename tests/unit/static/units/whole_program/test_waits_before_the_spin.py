"""Waits of the set-up, and whether who would end them is spun by then."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan

NODE = """\
import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'home')
        self.rate = self.create_rate(10)
        self.pose = None
        self.create_subscription(Empty, 'pose', self.on_pose, 10)

    def home(self):
        done = threading.Event()
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(lambda _: done.set())
        done.wait()

    def on_pose(self, msg):
        self.pose = msg

    def look(self):
        while self.pose is None and rclpy.ok():
            {look}

    def work(self):
        while rclpy.ok():
            {step}
            self.rate.sleep()


def main():
    rclpy.init()
    node = Asker()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin, daemon=True)
    {first}
    {then}
    {last}


main()
"""
START, ASK, CALL = 'thread.start()', 'node.home()', 'node.client.call(Trigger.Request())'
LOOK, WORK, NOTHING = 'node.look()', 'node.work()', 'pass'
EVENT = 'Event.wait waits for done, but nothing spins the node whose callback would end it'
ANSWER = (
    "client.call waits for the answer of 'home' while nothing spins the node that must take it"
)
POSE = (
    'a polling loop waits for Asker.pose, but nothing spins the node whose callback would end it'
)
SLEEP = 'Rate.sleep waits for a timer while nothing spins the node that has it'


@pytest.mark.parametrize(
    ('steps', 'in_loop', 'told'),
    [
        ((ASK, START, NOTHING), NOTHING, [EVENT]),
        ((ASK, START, ASK), NOTHING, [EVENT]),
        ((START, ASK, ASK), NOTHING, []),
        ((CALL, START, NOTHING), NOTHING, [ANSWER]),
        ((START, CALL, ASK), NOTHING, []),
        ((LOOK, START, NOTHING), 'time.sleep(0.1)', [POSE]),
        ((START, LOOK, NOTHING), 'time.sleep(0.1)', []),
        ((LOOK, START, NOTHING), 'rclpy.spin_once(self, timeout_sec=0.1)', []),
        ((WORK, NOTHING, NOTHING), 'rclpy.spin_once(self, timeout_sec=0.0)', [SLEEP]),
        ((START, WORK, NOTHING), NOTHING, []),
    ],
)
def test_a_thread_that_is_started_later_serves_nobody_before(
    tmp_path: Path, steps: tuple[str, str, str], in_loop: str, told: list[str]
) -> None:
    path = tmp_path / 'asker.py'
    first, then, last = steps
    path.write_text(NODE.format(first=first, then=then, last=last, step=in_loop, look=in_loop))

    found = scan([path])

    messages = [each.message for each in found.diagnostics if each.slug == 'nobody-spins']
    assert [message.removesuffix(': it waits forever') for message in messages] == told
