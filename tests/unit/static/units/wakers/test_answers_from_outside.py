"""Waits for the message by which another process answers one that was published before."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import queue
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.come = threading.Event()
        self.answers = queue.Queue()
        self.answer = None
        self.pub = self.create_publisher(String, 'question', 10)
        self.create_subscription(String, '/answer', self.on_answer, 10)
        group = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'ask', self.on_ask, callback_group=group)

    def on_answer(self, msg):
        self.answer = msg.data
        self.answers.put(msg.data)
        self.come.set()

    def on_ask(self, request, response):
        {ask}
        return response

class Other(Node):
    def __init__(self):
        super().__init__('other')
        self.pub = self.create_publisher(String, '{topic}', 10)
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.pub.publish(String())

rclpy.init()
executor = MultiThreadedExecutor(3)
executor.add_node(Asker())
executor.add_node(Other())
executor.spin()
"""
SEND = 'self.pub.publish(String())'
EVENT = 'self.come.wait()'
POLL = 'while self.answer is None:\n            time.sleep(0.1)'


def _answers(ask: str, topic: str = 'status') -> list[str | None]:
    (unit,) = scan_text(PROGRAM.format(ask=ask, topic=topic)).units
    (on_ask,) = [each for each in unit.callbacks if each.name == 'on_ask']
    return [block.answer_to for block in on_ask.blocking if block.call != 'time.sleep']


@pytest.mark.parametrize('wait', [EVENT, 'self.answers.get()', POLL])
def test_an_answer_from_outside(wait: str) -> None:
    assert _answers(f'{SEND}\n        {wait}') == ['question']


@pytest.mark.parametrize(
    ('ask', 'topic'),
    [
        (EVENT, 'status'),  # nothing is sent: messages are taken to come by themselves
        (f'{EVENT}\n        {SEND}', 'status'),
        (f'{SEND}\n        self.come.wait(timeout=1.0)', 'status'),
        (f'{SEND}\n        {EVENT}', 'answer'),  # known code sends it
        (POLL.replace('time.sleep(0.1)', f'{SEND}\n            time.sleep(0.1)'), 'status'),
    ],
)
def test_what_is_no_answer_from_outside(ask: str, topic: str) -> None:
    assert _answers(ask, topic) == [None]
