"""States that stand for flags: code that finds one, and stores another, keeps others out."""

from __future__ import annotations

import pytest

from tests.help.cases import said

PROGRAM = """
import threading
from enum import Enum, IntEnum, auto
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class State(Enum):
    IDLE = auto()
    BUSY = auto()
    DONE = auto()

class Level(IntEnum):
    IDLE = 0
    BUSY = 1

class Worker(Node):
    OFF = 'off'
    ON = 'on'

    def __init__(self):
        super().__init__('worker')
        self.lock = threading.Lock()
        self.state = {down}
        self.count = 0
        group = ReentrantCallbackGroup()
        self.create_subscription(String, 'work', self.on_work, 10, callback_group=group)
        self.create_subscription(String, 'reset', self.on_reset, 10, callback_group=group)

    def on_work(self, msg):
        with self.lock:
            if {test}:
                return
            self.state = {up}
        self.count += 1
        with self.lock:
            self.state = {down}

    def on_reset(self, msg):
        {reset}

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Worker())
executor.spin()
"""
IDLE, BUSY = 'State.IDLE', 'State.BUSY'


def _count_is_told(*, test: str, up: str, down: str, reset: str = 'pass') -> bool:
    text = PROGRAM.format(test=test, up=up, down=down, reset=reset)
    return any('Worker.count' in each.message for each in said(text))


@pytest.mark.parametrize(
    ('test', 'up', 'down'),
    [
        ('self.state is State.BUSY', BUSY, IDLE),
        ('self.state is not State.IDLE', BUSY, IDLE),
        ('not self.state == State.IDLE', BUSY, IDLE),
        ("self.state is State.BUSY or msg.data == ''", BUSY, IDLE),
        ('self.state == Level.BUSY', 'Level.BUSY', 'Level.IDLE'),
        ('self.state != self.OFF', 'Worker.ON', 'self.OFF'),
        ('self.state == 2', '2', '3'),
    ],
)
def test_a_state_keeps_others_out(test: str, up: str, down: str) -> None:
    assert not _count_is_told(test=test, up=up, down=down)


@pytest.mark.parametrize(
    ('test', 'up', 'down', 'reset'),
    [
        # What is stored is not what others ask for.
        ('self.state is State.DONE', BUSY, IDLE, 'pass'),
        ('self.state is State.BUSY', 'State.DONE', IDLE, 'pass'),
        ('self.state is not State.IDLE', IDLE, IDLE, 'pass'),
        ('self.state is State.BUSY', 'msg.data', IDLE, 'pass'),
        # Somebody else puts it down.
        ('self.state is State.BUSY', BUSY, IDLE, 'self.state = State.IDLE'),
        # It shows nothing alone.
        ("self.state is State.BUSY and msg.data == ''", BUSY, IDLE, 'pass'),
    ],
)
def test_a_state_that_keeps_nobody_out(test: str, up: str, down: str, reset: str) -> None:
    assert _count_is_told(test=test, up=up, down=down, reset=reset)


def test_two_that_find_different_states_do_not_keep_each_other_out() -> None:
    other = (
        'with self.lock:\n            if self.state is not State.IDLE:\n                return\n'
        '            self.state = State.DONE\n        self.count += 1\n'
        '        with self.lock:\n            self.state = State.IDLE'
    )
    assert _count_is_told(test='self.state is State.BUSY', up=BUSY, down=IDLE, reset=other)
    assert not _count_is_told(test='self.state is not State.IDLE', up=BUSY, down=IDLE, reset=other)
