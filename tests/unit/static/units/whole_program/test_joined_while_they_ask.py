"""Threads that ask a service in a loop, and are joined when the spin is over."""

from __future__ import annotations

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import time

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.client = self.create_client(Trigger, 'feed')
        self.running = True
        self.worker = threading.Thread(target=self.work)
        self.worker.start()

    def work(self):
        {works}


rclpy.init()
node = Base()
{end}
"""
LOOP = 'while self.running:\n            '
CALL = 'self.client.call(Trigger.Request())'
POLL = (
    'asked = self.client.call_async(Trigger.Request())\n            while not asked.done():\n'
    '                time.sleep(0.1)'
)
LATE = 'rclpy.spin(node)\nnode.running = False\nnode.worker.join()'
ASIDE = (
    'spinner = threading.Thread(target=rclpy.spin, args=(node,))\nspinner.start()\n'
    'node.running = False\nnode.worker.join()\nrclpy.shutdown()\nspinner.join()'
)


def told(works: str, end: str) -> list[tuple[Severity, str, str]]:
    scan = scan_text(PROGRAM.format(works=works, end=end))
    found = [d for d in scan.diagnostics if d.slug == 'nobody-spins']
    return [(d.severity, d.message.replace('node.py:', ''), d.help) for d in found]


@pytest.mark.parametrize(
    ('ask', 'wait', 'line'), [(CALL, 'client.call', 20), (POLL, 'a busy loop', 21)]
)
def test_a_thread_that_asks_again_may_never_be_joined(ask: str, wait: str, line: int) -> None:
    ((severity, message, help_),) = told(LOOP + ask, LATE)
    assert severity is Severity.WARNING
    assert message == (
        f'Thread.join waits for a thread that waits in {wait} for an answer ({line}:13), and '
        'nothing spins the node whose callback would end that any more: it may wait forever'
    )
    assert help_ == (
        'join it while the node is still spun, or wait for the answer with a time-out'
    )


@pytest.mark.parametrize(
    ('works', 'end'),
    [
        (CALL, LATE),
        (LOOP + CALL, ASIDE),
        (LOOP + 'self.client.call_async(Trigger.Request())', LATE),
        (LOOP + CALL, 'rclpy.spin(node)'),
    ],
    ids=['it asks once', 'it is spun meanwhile', 'it waits not', 'nobody joins it'],
)
def test_else_it_is_not_said_of_a_join(works: str, end: str) -> None:
    assert [message for _, message, _ in told(works, end) if 'Thread.join' in message] == []
