"""``while gate:`` asks a method of the object in each round, as ``while gate.is_shut():`` does."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

NODE = """
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Empty

class Gate:
    def __init__(self, node):
        self.node = node

    def METHOD(self):
        TRUTH

class Porter(Node):
    def __init__(self):
        super().__init__('porter')
        self.opened = threading.Event()
        self.is_open = False
        self.gate = Gate(self)
        group = ReentrantCallbackGroup()
        self.create_subscription(Empty, 'tick', self.on_tick, 10, callback_group=group)
        self.create_subscription(Empty, 'open', self.on_open, 10, callback_group=group)

    def on_tick(self, msg):
        while TEST:
            pass

    def on_open(self, msg):
        self.opened.set()
        self.is_open = True

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Porter())
executor.spin()
"""


def waits(method: str, test: str, truth: str) -> list[tuple[str, str | None, bool, int]]:
    """What ``on_tick`` waits in, for what, whether its end is known, and how many end it."""
    text = NODE.replace('METHOD', method).replace('TEST', test).replace('TRUTH', truth)
    (unit,) = scan_text(text).units
    tick = next(each for each in unit.callbacks if each.function_name == 'on_tick')
    return [
        (each.call, each.resource, each.escapes is None, len(each.wakers or ()))
        for each in tick.blocking
    ]


@pytest.mark.parametrize(
    ('test', 'truth'),
    [
        ('self.gate', 'self.node.opened.wait(); return False'),
        ('not self.gate', 'return self.node.opened.wait(0.5)'),
        ('not self.gate', 'return self.node.is_open'),
        ('not (self.gate or self.is_open)', 'return self.node.is_open'),
        ('rclpy.ok() and not self.gate', 'return self.node.is_open'),
    ],
)
def test_the_truth_of_an_object_is_what_its_method_says(test: str, truth: str) -> None:
    named = waits('ask', test.replace('self.gate', 'self.gate.ask()'), truth)
    assert named
    assert waits('__bool__', test, truth) == named
    assert waits('__len__', test, truth) == named
