"""Threads that are joined while only callbacks end their waits, and nobody serves these."""

from __future__ import annotations

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import queue
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Log(Node):
    def __init__(self):
        super().__init__('log')
        self.lines = queue.Queue()
        self.running = True
        self.create_subscription(String, 'line', self.heard, 10)
        self.writer = threading.Thread(target=self.write)
        self.writer.start()

    def heard(self, msg):
        self.lines.put(msg.data)

    def write(self):
        {write}

rclpy.init()
node = Log()
{end}
"""
LOOPS = 'while self.running:\n            print(self.lines.get())'
ENDING = """
rclpy.spin(node)
node.running = False
{wake}node.writer.join()
"""
UNTIL = """
rclpy.spin_until_future_complete(node, rclpy.Future())
node.running = False
node.writer.join()
"""
EARLY = 'node.writer.join()\nrclpy.spin(node)\n'
BESIDE = """
executor = SingleThreadedExecutor()
executor.add_node(node)
threading.Thread(target=executor.spin, daemon=True).start()
node.writer.join()
"""


@pytest.mark.parametrize(
    ('write', 'end', 'told'),
    [
        (LOOPS, ENDING.format(wake=''), [Severity.WARNING]),
        (LOOPS, UNTIL, [Severity.WARNING]),
        ('print(self.lines.get())', EARLY, [Severity.ERROR]),
        # One item was there perhaps, and the thread has ended.
        ('print(self.lines.get())', ENDING.format(wake=''), []),
        (LOOPS, ENDING.format(wake='node.lines.put(None)\n'), []),
        (LOOPS.replace('get()', 'get(timeout=1.0)'), ENDING.format(wake=''), []),
        ('print(self.lines.get())', BESIDE, []),
    ],
)
def test_a_join_that_nobody_serves(write: str, end: str, told: list[Severity]) -> None:
    found = scan_text(PROGRAM.format(write=write, end=end))
    mine = [each for each in found.diagnostics if 'Thread.join' in each.message]
    assert [each.severity for each in mine] == told
    assert all(each.slug == 'nobody-spins' for each in mine)
