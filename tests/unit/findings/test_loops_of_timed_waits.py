"""A loop that waits for an event with a time-out, again and again, waits until it is set."""

from __future__ import annotations

import pytest

from tests.help.cases import said

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Latch:
    def __init__(self):
        self.event = threading.Event()

    def wait(self, timeout=None):
        return self.event.wait(timeout)

class Stop(Node):
    def __init__(self):
        super().__init__('stop')
        self.group = ReentrantCallbackGroup()
        self.released, self.latch = threading.Event(), Latch()
        self.create_service(Trigger, 'release', self.release, callback_group=self.group)
        self.create_timer(1.0, self.work, callback_group=self.group)

    def release(self, request, response):
        self.released.set()
        self.latch.event.set()
        return response

    def work(self):
        tries, begun = 0, time.monotonic()
        WAITS

def main():
    rclpy.init()
    stop = Stop()
    RUNS

if __name__ == '__main__':
    main()
"""
COUNTED = """\
while not self.released.wait(0.5):
            tries += 1
            if tries > 9: return
"""
ONE = 'rclpy.spin(stop)'
POOL = """\
executor = MultiThreadedExecutor(4)
    executor.add_node(stop)
    executor.spin()
"""


def lines(waits: str, runs: str = ONE) -> list[tuple[str, int]]:
    text = PROGRAM.replace('WAITS', waits).replace('RUNS', runs)
    return [(each.code, each.line) for each in said(text) if 'forever' in each.message]


@pytest.mark.parametrize('test', ['self.released.wait(0.5)', 'self.latch.wait(timeout=0.5)'])
@pytest.mark.parametrize('waits', ['while not {}: pass', 'while True:\n            if {}: break'])
def test_on_one_thread_it_never_ends(test: str, waits: str) -> None:
    found = lines(waits.format(test))
    assert [line for _, line in found if line >= 31]
    assert lines(waits.format(test), POOL) == []


@pytest.mark.parametrize(
    'waits',
    [
        'self.released.wait(0.5)',
        'if not self.released.wait(0.5): return',
        'while not self.released.wait(0.5) and tries < 9: tries += 1',
        'while not self.released.wait(0.5) and time.monotonic() - begun < 9.0: pass',
        'while not self.released.wait(0.5): break',
        'while not self.released.wait(0.5): self.released.set()',
        COUNTED,
        'while not self.released.is_set():\n            self.released.set()',
        'for _ in range(3):\n            if self.released.wait(0.5): break',
    ],
)
def test_what_ends_otherwise_does(waits: str) -> None:
    assert lines(waits) == []
