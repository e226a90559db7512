"""What ``main`` stores after a thread has begun ends the thread, wherever it spins or not."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Sender(Node):
    def __init__(self):
        super().__init__('sender')
        self.going, self.speed = True, 0.0
        self.create_subscription(String, 'speed', print, 10)
        self.worker = threading.Thread(target=self.send)

    def send(self):
        while self.going:
            self.sent = [self.speed]
            time.sleep(0.05)

    def run(self):
        {}


rclpy.init()
node = Sender()
rclpy.spin_once(node)
node.run()
"""
START = 'self.worker.start()\n        '
TRY = 'try:\n            self.speed = 2.0\n        finally:\n            self.going = False'


def enders(does: str) -> list[str]:
    """Who ends the loop of the thread."""
    (unit,) = scan_text(PROGRAM.format(does)).units
    (thread,) = unit.activities
    blocks = [block for block in thread.blocking if block.resource == 'Sender.going']
    return [waker.by for block in blocks for waker in block.wakers]


@pytest.mark.parametrize('ends', ['self.going = False', TRY])
def test_main_ends_a_thread_that_it_has_started(ends: str) -> None:
    assert enders(f'{START}{ends}') == ['outside']


def test_what_main_stores_before_ends_nothing() -> None:
    assert enders(f'self.speed = 1.0\n        {START}pass') == []
