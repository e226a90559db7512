"""CC301, CC303: what the predicate of ``Condition.wait_for`` reads only ends that wait."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

GATE = """
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Gate:
    def __init__(self):
        self.turn = threading.Condition()
        self.guest = None
        self.last = None

    def has_gone(self):
        return self.guest is None

    def keeps(self):
        self.last = self.guest
        return self.last is None

    def pass_by(self, name):
        self.guest = name
        with self.turn:
            {wait}

    def open(self):
        with self.turn:
            self.guest = None
            self.turn.notify_all()


class Porter(Node):
    def __init__(self):
        super().__init__('porter')
        self.gate = Gate()
        for topic, callback in (('a', self.on_a), ('b', self.on_b), ('c', self.on_c)):
            group = MutuallyExclusiveCallbackGroup()
            self.create_subscription(String, topic, callback, 10, callback_group=group)

    def on_a(self, msg):
        print(self.gate.pass_by(msg.data))

    def on_b(self, msg):
        print(self.gate.pass_by(msg.data))

    def on_c(self, msg):
        self.gate.open()


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Porter())
executor.spin()
"""
ASKED = 'self.turn.wait_for(lambda: self.guest is None or self.guest != name)'
NAMED = """def gone():
                return self.guest != name
            self.turn.wait_for(gone)"""
TIMED = """while not self.turn.wait_for(self.has_gone, timeout=1.0):
                print('still here')"""
USED = 'return self.turn.wait_for(lambda: self.guest)'
TESTED = """if self.turn.wait_for(lambda: self.guest is None, 1.0):
                print('gone')"""


def _read_back(wait: str) -> list[str]:
    units = scan_text(GATE.format(wait=wait)).units
    found = findings_of(units, [], [None] * len(units))
    return [f.message for f in found if 'waits and reads' in f.message and 'guest' in f.message]


@pytest.mark.parametrize(
    'wait',
    [ASKED, NAMED, TIMED, 'self.turn.wait_for(self.has_gone)', f'{ASKED}\n            pass'],
)
def test_a_predicate_reads_nothing_back(wait: str) -> None:
    assert not _read_back(wait)


@pytest.mark.parametrize(
    'wait',
    [
        USED,
        TESTED,
        'self.turn.wait_for(self.keeps)',
        f'{ASKED}\n            return self.guest',
        'self.turn.wait()\n            return self.guest',
    ],
)
def test_what_is_kept_of_it_or_read_behind_it_is_read_back(wait: str) -> None:
    assert _read_back(wait)
