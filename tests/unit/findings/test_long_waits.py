"""Callbacks that hold up a fast timer by rates and by waits with time-outs; rates of messages."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

NODE = """\
import select
import subprocess
import threading
import urllib.request

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Slow(Node):
    def __init__(self):
        super().__init__('slow')
        other = MutuallyExclusiveCallbackGroup()
        self.event = threading.Event()
        self.rate = self.create_rate(1.0)
        self.client = self.create_client(Trigger, 'far', callback_group=other)
        self.create_subscription(Empty, 'done', self.on_done, 10, callback_group=other)
        self.create_timer(5.0, self.work, callback_group={group})
        self.create_timer({period}, self.beat)

    def on_done(self, msg):
        self.event.set()

    def work(self):
        {work}  # here

    def beat(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=6)
    executor.add_node(Slow())
    executor.spin()


main()
"""
FILTER = """\
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Filter(Node):
    def __init__(self):
        super().__init__('filter')
        self.count = 0
        self.pub = self.create_publisher(Empty, {topic!r}, 10)
        self.create_timer(0.1, self.send)
        group = ReentrantCallbackGroup()
        self.create_subscription(Empty, 'scan', self.on_scan, 10, callback_group=group)

    def on_scan(self, msg):
        self.count += hash(msg)  # here

    def send(self):
        self.pub.publish(Empty())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Filter())
    executor.spin()


main()
"""
RATES = 'for _ in range(3):\n            self.rate.sleep()'
ANSWER = 'self.client.call(Trigger.Request(), timeout_sec=2.0)'
EVENT = 'self.event.wait(timeout=2.0)'
DEVICE = 'select.select([0], [], [], 1.5)'
SERVER = "urllib.request.urlopen('http://robot', timeout=2.0)"
CHILD = "subprocess.run(['scan'], timeout=5.0)"
DEFAULT, OWN = 'None', 'MutuallyExclusiveCallbackGroup()'
LONG_SLEEP, OVERLAP = 'CC201', 'CC304'


def said(path: Path, code: str) -> list[tuple[int, str]]:
    """Line and severity of each finding of a code."""
    out = StringIO()
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    found = json.loads(out.getvalue())['findings']
    return [(each['line'], each['severity']) for each in found if each['code'] == code]


def line_of_mark(path: Path) -> int:
    """Where the node says that it is meant."""
    lines = path.read_text().splitlines()
    return next(number for number, text in enumerate(lines, 1) if text.endswith('# here'))


@pytest.mark.parametrize(
    ('work', 'group', 'period', 'severity'),
    [
        (RATES, DEFAULT, 0.1, 'warning'),
        (RATES, OWN, 0.1, None),
        (ANSWER, DEFAULT, 0.1, 'note'),
        (ANSWER, DEFAULT, 1.0, None),
        (EVENT, DEFAULT, 0.1, 'note'),
        (EVENT, OWN, 0.1, None),
        (DEVICE, DEFAULT, 0.1, 'warning'),
        (DEVICE, OWN, 0.1, None),
        (DEVICE.replace('1.5', '0.01'), DEFAULT, 0.1, None),
        (SERVER, DEFAULT, 0.1, 'warning'),
        (CHILD, DEFAULT, 0.1, 'warning'),
    ],
)
def test_what_makes_a_timer_miss_its_runs_is_told(
    tmp_path: Path, work: str, group: str, period: float, severity: str | None
) -> None:
    path = tmp_path / 'slow.py'
    path.write_text(NODE.format(work=work, group=group, period=period))

    expected = [] if severity is None else [(line_of_mark(path), severity)]
    assert said(path, LONG_SLEEP) == expected


@pytest.mark.parametrize(('topic', 'severity'), [('scan', 'note'), ('other', 'warning')])
def test_messages_of_a_timer_come_together_only_when_held_up(
    tmp_path: Path, topic: str, severity: str
) -> None:
    path = tmp_path / 'filter.py'
    path.write_text(FILTER.format(topic=topic))

    assert said(path, OVERLAP) == [(line_of_mark(path), severity)]
