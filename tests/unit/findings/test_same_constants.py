"""CC301, CC303, CC304: a constant that all store by one statement is the same, whose it is."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

SORTER = """
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Sorter(Node):
    def __init__(self):
        super().__init__('sorter')
        self.seen = {begin}
        {subscriptions}

    def on_a(self, msg):
        self.ask('a')

    def on_b(self, msg):
        self.ask('b')

    def ask(self, name):
        {store}
        time.sleep(0.1)
        if self.seen:
            print('seen', self.seen)
        {end}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Sorter())
executor.spin()
"""
TWO = """for topic, callback in (('a', self.on_a), ('b', self.on_b)):
            self.create_subscription(
                Empty, topic, callback, 10, callback_group=MutuallyExclusiveCallbackGroup())"""
ONE = """self.create_subscription(
            Empty, 'a', self.on_a, 10, callback_group=ReentrantCallbackGroup())"""


def _read_back(store: str, subscriptions: str, end: str = 'pass', begin: str = 'None') -> bool:
    text = SORTER.format(store=store, subscriptions=subscriptions, end=end, begin=begin)
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    return any('reads it back' in f.message or 'reads it here' in f.message for f in found)


@pytest.mark.parametrize('subscriptions', [TWO, ONE])
@pytest.mark.parametrize(
    'store',
    [
        'self.seen = True',
        "self.seen = 'busy'",
        'self.seen = None',
        'self.seen = False',
        'self.seen = self.begun = 7',
        'if name: self.seen = True',
    ],
)
def test_one_constant_is_no_answer_to_one_of_them(store: str, subscriptions: str) -> None:
    assert not _read_back(store, subscriptions, begin='0.5')


@pytest.mark.parametrize(
    ('store', 'subscriptions'),
    [
        ('self.seen = name', TWO),
        ('self.seen = time.time()', TWO),
        ('self.seen = time.time()', ONE),
        ('self.seen = 1 if time.time() > 9 else 2', ONE),
        ("self.seen = 'a' if msg.data else 'b'", TWO),
    ],
)
def test_a_value_of_its_own_is(store: str, subscriptions: str) -> None:
    assert _read_back(store, subscriptions)


def test_what_another_line_of_the_run_stores_is_another_value() -> None:
    assert _read_back('self.seen = True', ONE, end='self.seen = False')
