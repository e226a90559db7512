"""Publishers that are destroyed while somebody else publishes by them."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan

NODE = """\
import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        self.out = self.create_publisher(Empty, 'a', 10)
        self.lock = threading.Lock()
        self.going = True
        self.worker = threading.Thread(target=self.work)
        self.create_timer(1.0, self.change)
        self.create_timer(0.1, self.flash, callback_group=MutuallyExclusiveCallbackGroup())
        self.worker.start()

    def work(self):
        {work}

    def flash(self):
        {flash}

    def change(self):
        {change}


def main():
    rclpy.init()
    lamp = Lamp()
    executor = {executor}
    executor.add_node(lamp)
    executor.spin()


main()
"""
SINGLE, POOL = 'SingleThreadedExecutor()', 'MultiThreadedExecutor(num_threads=3)'
BY_THREAD = 'while self.going:\n            self.out.publish(Empty())'
LOCKED = (
    'while self.going:\n            with self.lock:\n                self.out.publish(Empty())'
)
ANEW = "self.destroy_publisher(self.out)\n        self.out = self.create_publisher(Empty, 'b', 10)"
JOINED = 'self.going = False\n        self.worker.join()\n        ' + ANEW
SWAPPED = """\
new = self.create_publisher(Empty, 'b', 10)
        with self.lock:
            old, self.out = self.out, new
        self.destroy_publisher(old)"""


@pytest.mark.parametrize(
    ('work', 'flash', 'change', 'executor', 'told'),
    [
        (BY_THREAD, 'pass', ANEW, SINGLE, True),
        (BY_THREAD, 'pass', JOINED, SINGLE, False),
        (LOCKED, 'pass', SWAPPED, SINGLE, False),
        ('pass', 'self.out.publish(Empty())', ANEW, SINGLE, False),
        ('pass', 'self.out.publish(Empty())', ANEW, POOL, True),
    ],
)
def test_who_may_still_publish(
    tmp_path: Path, work: str, flash: str, change: str, executor: str, told: bool
) -> None:
    path = tmp_path / 'lamp.py'
    path.write_text(NODE.format(work=work, flash=flash, change=change, executor=executor))
    found = [d.message for d in scan([path]).diagnostics if d.slug == 'served-no-more']
    assert len(found) == told
    assert all('InvalidHandle' in message for message in found)
