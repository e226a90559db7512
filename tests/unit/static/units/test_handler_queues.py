"""A handler of a signal uses a queue that the thread which it interrupts may use just then."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import queue
import signal
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Worker(Node):
    def __init__(self):
        super().__init__('worker')
        self.jobs = queue.{kind}()
        self.create_timer(0.01, self.work)

    def work(self):
        {works}

    def stop(self, number, frame):
        {stops}


rclpy.init()
node = Worker()
signal.signal(signal.SIGUSR1, node.stop)
{spins}
"""
TAKES, PUTS, SPIN = 'self.jobs.get_nowait()', 'self.jobs.put(None)', 'rclpy.spin(node)'
POOL = 'executor = MultiThreadedExecutor(2)\nexecutor.add_node(node)\nexecutor.spin()'


@pytest.mark.parametrize(
    ('kind', 'works', 'stops', 'spins', 'lines'),
    [
        ('Queue', TAKES, PUTS, SPIN, [18]),
        ('PriorityQueue', 'self.jobs.put(1)', TAKES, SPIN, [18]),
        ('SimpleQueue', TAKES, PUTS, SPIN, []),
        ('Queue', 'pass', PUTS, SPIN, []),
        ('Queue', TAKES, 'pass', SPIN, []),
        ('Queue', TAKES, PUTS, POOL, []),
    ],
)
def test_its_lock_may_be_held(
    kind: str, works: str, stops: str, spins: str, lines: list[int]
) -> None:
    text = PROGRAM.format(kind=kind, works=works, stops=stops, spins=spins)
    found = scan_text(text).diagnostics
    assert [each.place.line for each in found if each.slug == 'lock-order'] == lines
