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


BEHIND = """\
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty


class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        self.out = self.create_publisher(Empty, 'a', 10)
        self.ended = threading.Event()
        self.create_timer(1.0, self.ended.set)
        self.worker = threading.Thread(target=self.work)
        self.worker.start()

    def work(self):
        {work}


def main():
    rclpy.init()
    lamp = Lamp()
    while {test}:
        rclpy.spin_once(lamp)
    {end}
    rclpy.shutdown()


main()
"""
FLAG = 'rclpy.ok() and not lamp.ended.is_set()'
AGAIN = 'while not self.ended.is_set():\n            self.out.publish(Empty())'
ONCE = 'self.out.publish(Empty())'
DESTROYED, WAITED = 'lamp.destroy_node()', 'lamp.worker.join()\n    lamp.destroy_node()'
LATE = 'lamp.destroy_node()\n    lamp.worker.join()'


@pytest.mark.parametrize(
    ('work', 'test', 'end', 'told'),
    [
        (AGAIN, FLAG, DESTROYED, True),
        (AGAIN, FLAG, LATE, True),
        (AGAIN, FLAG, WAITED, False),
        (AGAIN, FLAG, 'lamp.worker.join(timeout=1.0)\n    lamp.destroy_node()', False),
        (ONCE, FLAG, DESTROYED, False),
        # rclpy is down by then.
        (AGAIN, 'rclpy.ok()', DESTROYED, False),
    ],
)
def test_a_thread_that_may_publish_behind_its_node(
    tmp_path: Path, work: str, test: str, end: str, told: bool
) -> None:
    path = tmp_path / 'lamp.py'
    path.write_text(BEHIND.format(work=work, test=test, end=end))
    found = [d for d in scan([path]).diagnostics if d.slug == 'served-no-more']
    line = 1 + path.read_text().splitlines().index('    lamp.destroy_node()')
    assert [d.place.line for d in found] == [line] * told
    assert all('a thread may still publish by it' in d.message for d in found)
