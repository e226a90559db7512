"""CC305: also a timer, a thread or an event that is set to ``None`` may be in use."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import queue
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.held = None
        self.lock = threading.Lock()
        self.create_subscription(Empty, 'go', self.on_go, 10)
        self.create_subscription(Empty, 'stop', self.on_stop, 10)
        self.create_timer(0.1, self.check, callback_group=MutuallyExclusiveCallbackGroup())

    def on_go(self, msg):
        self.held = MADE

    def check(self):
        with AROUND:
            if self.held is not None:
                print('there')
                self.held.USED

    def on_stop(self, msg):
        with AROUND:
            self.held = None

    def tick(self):
        pass

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Arm())
executor.spin()
"""
FREE = 'memoryview(b"")'
KINDS = [
    ('threading.Event()', 'set()'),
    ('threading.Thread(target=print)', 'is_alive()'),
    ('queue.Queue()', 'put(1)'),
    ('self.create_publisher(Empty, "out", 1)', 'publish(Empty())'),
    ('self.create_timer(1.0, self.tick)', 'cancel()'),
    ('Empty()', 'show()'),
]


def lines(text: str, around: str) -> list[tuple[int, str]]:
    units = scan_text(text.replace('AROUND', around)).units
    found = findings_of(units, [], [None] * len(units))
    return [(each.place.line, each.severity.value) for each in found if each.code == 'CC305']


@pytest.mark.parametrize(('made', 'used'), KINDS)
def test_an_object_of_any_kind_may_be_gone_when_it_is_used(made: str, used: str) -> None:
    text = PROGRAM.replace('MADE', made).replace('USED', used)
    assert lines(text, FREE) == [(26, 'warning')]
    assert lines(text, 'self.lock') == []


@pytest.mark.parametrize(
    ('used', 'is_used'),
    [
        ('print(2 - self.held)', True),
        ('print(self.held < 2)', True),
        ('print(1 < 2 <= self.held)', True),
        ('print("x" in self.held)', True),
        ('print(self.held % 2)', True),
        ('print("%s" % self.held)', False),
        ('print(self.held == 2)', False),
        ('print(self.held)', False),
    ],
)
def test_an_operand_that_must_be_there_is_used(used: str, is_used: bool) -> None:
    text = PROGRAM.replace('MADE', 'msg').replace('self.held.USED', used)
    assert lines(text, FREE) == ([(26, 'warning')] if is_used else [])


WORKER = """\
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.worker = None
        self.create_subscription(Empty, 'go', self.on_go, 10)
        self.create_subscription(Empty, 'stop', self.on_stop, 10)

    def on_go(self, msg):
        if self.worker is None:
            self.worker = threading.Thread(target=self.work)
            self.worker.start()

    def on_stop(self, msg):
        worker = self.worker
        if WORKER is not None:
            print('stops')
            WORKER.join(timeout=1.0)

    def work(self):
        time.sleep(0.1)
        self.worker = None

rclpy.init()
rclpy.spin(Arm())
"""


@pytest.mark.parametrize(
    ('worker', 'expected'), [('self.worker', [(23, 'warning')]), ('worker', [])]
)
def test_a_thread_that_takes_itself_away_may_do_so_in_between(
    worker: str, expected: list[tuple[int, str]]
) -> None:
    assert lines(WORKER.replace('WORKER', worker), FREE) == expected
