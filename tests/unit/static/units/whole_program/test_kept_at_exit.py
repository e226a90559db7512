"""Threads that keep the program when it is over, as nobody ends what they wait for."""

from __future__ import annotations

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import os
import queue
import threading
import time
from concurrent.futures import ThreadPoolExecutor
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Log(Node):
    def __init__(self):
        super().__init__('log')
        self.lines = queue.Queue()
        self.come = threading.Event()
        self.pub = self.create_publisher(String, 'out', 10)
        self.create_subscription(String, 'line', self.heard, 10)

    def heard(self, msg):
        self.lines.put({item})
        self.come.set()

def write(node):
    {write}

rclpy.init()
node = Log()
{start}
{end}
"""
GET = 'while True:\n        print(node.lines.get())'
LEAVES = (
    'while True:\n        line = node.lines.get()\n'
    '        if line is None:\n            break\n        print(line)'
)
CLEARS = 'while rclpy.ok():\n        node.come.wait()\n        node.come.clear()'
SLEEPS = 'while True:\n        time.sleep(0.1)'
PLAIN = 'threading.Thread(target=write, args=(node,)).start()'
POOL = 'pool = ThreadPoolExecutor(1)\npool.submit(write, node)'
DAEMON = 'threading.Thread(target=write, args=(node,), daemon=True).start()'
SET_DAEMON = 'thread = threading.Thread(target=write, args=(node,))\nthread.{}\nthread.start()'
NOT_KNOWN = 'threading.Thread(target=write, args=(node,), daemon=bool(os.getpid())).start()'
JOINED = 'thread = threading.Thread(target=write, args=(node,))\nthread.start()'
SPIN = 'rclpy.spin(node)\nrclpy.shutdown()'
UNTIL = 'rclpy.spin_until_future_complete(node, rclpy.Future())'
BESIDE = """
executor = SingleThreadedExecutor()
executor.add_node(node)
threading.Thread(target=executor.spin, daemon=True).start()
"""


def told(*, write: str, start: str = PLAIN, end: str = SPIN, item: str = 'msg.data') -> list[str]:
    found = scan_text(PROGRAM.format(write=write, start=start, end=end, item=item)).diagnostics
    mine = [each for each in found if 'the program ends only when' in each.message]
    assert all((e.slug, e.severity) == ('nobody-spins', Severity.WARNING) for e in mine)
    return [each.message for each in mine]


@pytest.mark.parametrize('end', [SPIN, UNTIL, f'{BESIDE}time.sleep(9.0)\nrclpy.shutdown()'])
@pytest.mark.parametrize('start', [PLAIN, POOL])
@pytest.mark.parametrize('write', [GET, LEAVES, CLEARS, SLEEPS])
def test_the_program_stays(write: str, start: str, end: str) -> None:
    assert len(told(write=write, start=start, end=end)) == 1


@pytest.mark.parametrize(
    'start',
    [DAEMON, SET_DAEMON.format('daemon = True'), SET_DAEMON.format('setDaemon(True)'), NOT_KNOWN],
)
@pytest.mark.parametrize('write', [GET, SLEEPS])
def test_daemons_keep_nothing(write: str, start: str) -> None:
    assert told(write=write, start=start) == []


@pytest.mark.parametrize(
    'write',
    [
        'print(node.lines.get())',  # one item was there perhaps, and the thread has ended
        'while rclpy.ok():\n        time.sleep(0.1)',
        GET.replace('get()', 'get(timeout=1.0)').replace('True', 'rclpy.ok()'),
        # It raises when rclpy is shut down.
        'while True:\n        node.pub.publish(String())\n        time.sleep(0.1)',
        'while True:\n        time.sleep(0.1)\n        if node.lines.empty():\n            return',
    ],
)
def test_a_thread_that_ends_keeps_nothing(write: str) -> None:
    assert told(write=write) == []


@pytest.mark.parametrize('end', ['node.lines.put(None)', 'os._exit(0)'])
def test_a_program_that_ends_it_has_an_end(end: str) -> None:
    assert told(write=GET, end=f'{SPIN}\n{end}') == []


@pytest.mark.parametrize('item', ['None', "'stop'"])
def test_a_callback_may_tell_it_to_stop(item: str) -> None:
    assert told(write=LEAVES, item=item) == []


def test_a_thread_that_is_served_meanwhile_may_end() -> None:
    assert told(write=GET, end=BESIDE) == []


def test_who_joins_a_thread_is_told_of_it_there() -> None:
    text = PROGRAM.format(
        write=LEAVES, start=JOINED, end=f'{SPIN}\nthread.join()', item='msg.data'
    )
    (one,) = (each for each in scan_text(text).diagnostics if each.slug == 'nobody-spins')
    assert one.message.startswith('Thread.join waits for a thread that waits in Queue.get')
