"""Threads that run while rclpy is up, and are waited for before it is shut down."""

from __future__ import annotations

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Log(Node):
    def __init__(self):
        super().__init__('log')
        self.running = True
        self.done = rclpy.Future()
        self.lines = self.create_publisher(String, 'line', 10)
        self.create_timer(0.1, self.tick)
        self.writer = threading.Thread(target=self.write{daemon})

    def tick(self):
        {tick}

    def write(self):
        while {test}:
            self.lines.publish(String())
            time.sleep(0.1)

class Joined(Log):
    def destroy_node(self):
        self.writer.join()
        super().destroy_node()

def main():
    {init}
    node = {cls}()
    node.writer.start()
    end = time.monotonic() + 2.0
{spin}
{end}

main()
"""
UNTIL = '    while time.monotonic() < end:\n        rclpy.spin_once(node)'
OF_OK = '    while rclpy.ok():\n        rclpy.spin_once(node)'
BROKEN = """    while True:
        rclpy.spin_once(node)
        if time.monotonic() > end:
            break"""
ANSWERED = '    rclpy.spin_until_future_complete(node, node.done)'
COUNTED = '    for _ in range(10):\n        rclpy.spin_once(node)'
IN_WITH = '    with started:\n        rclpy.spin_once(node)'
JOIN_FIRST = '    node.destroy_node()\n    rclpy.shutdown()'
SHUT_FIRST = '    rclpy.shutdown()\n    node.destroy_node()'
NO_SHUTDOWN = '    pass'
JOINED = (
    'Thread.join waits for a thread that runs while rclpy.ok() (node.py:21:9), and rclpy is not '
    'shut down before: it may wait forever'
)
KEPT = (
    'the program ends only when the non-daemon thread started here has ended; which runs while '
    'rclpy.ok() (node.py:21:9), and nothing shuts rclpy down: the program never exits'
)


def told(
    spin: str,
    end: str,
    test: str = 'rclpy.ok()',
    tick: str = 'self.done.set_result(None)',
    init: str = 'rclpy.init()',
    daemon: str = '',
    cls: str = 'Joined',
) -> list[str]:
    text = PROGRAM.format(
        spin=spin, end=end, test=test, tick=tick, init=init, daemon=daemon, cls=cls
    )
    found = [each for each in scan_text(text).diagnostics if each.slug == 'nobody-spins']
    assert all(each.severity is Severity.WARNING for each in found)
    return [each.message for each in found]


@pytest.mark.parametrize('spin', [UNTIL, BROKEN, ANSWERED, COUNTED])
def test_the_spin_ends_and_rclpy_goes_on(spin: str) -> None:
    assert told(spin, JOIN_FIRST) == [JOINED]
    assert told(spin, SHUT_FIRST) == []
    assert told(spin, NO_SHUTDOWN, cls='Log') == [KEPT]


@pytest.mark.parametrize('spin', ['    rclpy.spin(node)', OF_OK])
def test_a_spin_that_ends_with_rclpy_ends_the_thread(spin: str) -> None:
    assert told(spin, JOIN_FIRST) == told(spin, NO_SHUTDOWN, cls='Log') == []


def test_a_flag_or_a_callback_may_end_it() -> None:
    assert told(UNTIL, '    node.running = False\n' + JOIN_FIRST, test='node.running') == []
    assert told(UNTIL, JOIN_FIRST, tick='rclpy.shutdown()') == []


def test_who_spins_until_the_thread_is_over_joins_one_that_is() -> None:
    alive = '    while node.writer.is_alive():\n        rclpy.spin_once(node)'
    assert told(alive, JOIN_FIRST) == told(alive, NO_SHUTDOWN, cls='Log') == []


def test_nothing_waits_for_a_daemon() -> None:
    assert told(UNTIL, NO_SHUTDOWN, cls='Log', daemon=', daemon=True') == []


def test_the_end_of_a_with_block_shuts_down() -> None:
    both = 'started = rclpy.init()', 'started = rclpy.Context()'
    assert [told(IN_WITH, NO_SHUTDOWN, init=init, cls='Log') for init in both] == [[], []]
    assert [told(IN_WITH, JOIN_FIRST, init=init) for init in both] == [[], []]
    assert told(IN_WITH + '\n        node.destroy_node()', '', init=both[0]) == [JOINED]
