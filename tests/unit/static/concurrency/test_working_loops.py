"""A thread that works in rounds until it sets what it tests: it waits for nobody."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Backend(Node):
    def __init__(self):
        super().__init__('backend')
        self.create_subscription(String, 'go', self.go, 10)

    def go(self, msg):
        done = threading.Event()
        threading.Thread(target=self.watch, args=(done,), daemon=True).start()
        while rclpy.ok() and not done.is_set():
            time.sleep(0.2)

    def watch(self, done):
        rounds = 0
        while rclpy.ok() and not done.is_set():
            rounds += 1
            if ENDS:
                done.set()
                continue
            time.sleep(0.1)

rclpy.init()
rclpy.spin(Backend())
"""


@pytest.mark.parametrize('ends', ['rounds > 10', 'self.count_publishers("go")'])
def test_a_later_round_may_set_it(ends: str) -> None:
    (unit,) = scan_text(PROGRAM.replace('ENDS', ends)).units
    (go,) = unit.callbacks
    (watch,) = unit.activities
    (wait, _) = go.blocking
    assert [(waker.by, waker.conditional) for waker in wait.wakers] == [('watch', True)]
    loop = next(block for block in watch.blocking if block.call == 'working loop')
    assert loop.seconds is not None


def test_a_loop_that_only_others_end_has_no_end_of_its_own() -> None:
    text = PROGRAM.replace('done.set()', 'pass').replace('ENDS', 'self.count_publishers("go")')
    (unit,) = scan_text(text).units
    assert unit.activities[0].loops


def test_a_loop_that_a_request_to_cancel_ends_too_is_not_said_to_last_for_ever() -> None:
    text = PROGRAM.replace('done.set()', 'pass').replace('ENDS', 'self.handle.is_cancel_requested')
    text = text.replace('                continue', '                return')
    (unit,) = scan_text(text).units
    (loop, *_) = unit.activities[0].blocking
    assert loop.seconds is not None
