"""Entities that a base class makes of the methods which a decorator has marked."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

NODE = """
import inspect
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

def listens(topic):
    def mark(method):
        method.topic = topic
        return method
    return mark

class Wired(Node):
    def __init__(self, name):
        super().__init__(name)
        LOOP

class Dock(Wired):
    def __init__(self):
        self.seen = threading.Event()
        self.limit = 3
        super().__init__('dock')

    @listens('beacon')
    def on_beacon(self, msg):
        self.seen.set()

    @listens('go')
    def on_go(self, msg):
        self.seen.wait()

    def other(self):
        return self.limit

rclpy.init()
rclpy.spin(Dock())
"""

LOOPS = [
    """for name, method in inspect.getmembers(self, predicate=inspect.ismethod):
            if hasattr(method, 'topic'):
                self.create_subscription(Empty, method.topic, method, 10)""",
    """for name, method in inspect.getmembers(type(self), inspect.isfunction):
            topic = getattr(method, 'topic', None)
            if topic is not None:
                self.create_subscription(Empty, topic, method.__get__(self), 10)""",
    """for name in dir(type(self)):
            method = getattr(self, name)
            if hasattr(method, 'topic'):
                self.create_subscription(Empty, method.topic, getattr(self, name), 10)""",
]


@pytest.mark.parametrize('loop', LOOPS)
def test_marked_methods_are_callbacks_that_wait_for_each_other(loop: str) -> None:
    (unit,) = scan_text(NODE.replace('LOOP', loop)).units
    made = {each.function_name: each for each in unit.callbacks}
    assert {name: each.key for name, each in made.items()} == {
        'on_beacon': 'beacon',
        'on_go': 'go',
    }
    (wait,) = made['on_go'].blocking
    assert [waker.by for waker in wait.wakers] == ['on_beacon']
