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


SPUN = """
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
        self.rate = self.create_rate(4.0)
        self.create_subscription(String, 'line', self.heard, 10)
        self.writer = threading.Thread(target=self.write)
        self.writer.start()

    def heard(self, msg):
        self.lines.put(msg.data)

    def write(self):
        while self.running:
            {wait}

rclpy.init()
node = Log()
executor = SingleThreadedExecutor()
executor.add_node(node)
spinner = threading.Thread(target=executor.spin)
spinner.start()
node.running = False
{end}
"""
GET = 'print(self.lines.get())'
RATE = 'self.rate.sleep()'
MAY = [Severity.WARNING]


@pytest.mark.parametrize(
    ('wait', 'end', 'told'),
    [
        (GET, 'executor.shutdown()\nnode.writer.join()', MAY),
        (GET, 'rclpy.shutdown()\nspinner.join()\nnode.writer.join()', MAY),
        (GET, 'rclpy.shutdown()\nnode.writer.join()', MAY),
        (GET, 'node.writer.join()\nexecutor.shutdown()', []),
        (GET, 'if node.running:\n    executor.shutdown()\nnode.writer.join()', []),
        (GET, 'executor.shutdown()\nnode.lines.put(None)\nnode.writer.join()', []),
        (GET, 'executor.shutdown()\nnode.writer.join(timeout=1.0)', []),
        (GET, 'executor.shutdown()\nnode.lines.put(None)\nnode.writer.join()', []),
        (GET, 'SingleThreadedExecutor().shutdown()\nnode.writer.join()', []),
        (RATE, 'executor.shutdown()\nnode.writer.join()', MAY),
        (RATE, 'node.writer.join()\nexecutor.shutdown()', []),
        # The end of rclpy wakes who sleeps by a rate.
        (RATE, 'rclpy.shutdown()\nspinner.join()\nnode.writer.join()', []),
        (RATE, 'spinner.join()\nnode.writer.join()', []),
        (RATE, 'executor.shutdown()\nnode.destroy_rate(node.rate)\nnode.writer.join()', []),
        (RATE, 'executor.shutdown()\nnode.rate.destroy()\nnode.writer.join()', []),
        (
            RATE,
            'executor.shutdown()\nthreading.Thread(target=lambda: rclpy.spin(node)).start()\n'
            'node.writer.join()',
            [],
        ),
    ],
)
def test_a_join_after_the_spin_of_another_thread(
    wait: str, end: str, told: list[Severity]
) -> None:
    assert _joins(SPUN.format(wait=wait, end=end)) == told


ALONE = """
executor = SingleThreadedExecutor()
executor.add_node(node)
{spin}
node.running = False
{end}node.writer.join()
executor.shutdown()
"""
UNTIL_ARRIVED = 'executor.spin_until_future_complete(rclpy.Future())'


@pytest.mark.parametrize(
    ('spin', 'end', 'told'),
    [
        (UNTIL_ARRIVED, '', MAY),
        (UNTIL_ARRIVED, 'rclpy.shutdown()\n', []),
        # This one ends with rclpy, which wakes who sleeps by a rate.
        ('executor.spin()', '', []),
    ],
)
def test_a_rate_sleeps_on_when_main_has_spun(spin: str, end: str, told: list[Severity]) -> None:
    head = SPUN[: SPUN.index('executor = ')].format(wait=RATE)
    assert _joins(head + ALONE.format(spin=spin, end=end)) == told


FED = """
import queue
import threading
import rclpy

class Port:
    def __init__(self):
        self.frames = queue.Queue()
        self.running = True
        self.reader = threading.Thread(target=self.read)
        self.decoder = threading.Thread(target=self.decode)
        self.reader.start()
        self.decoder.start()

    def read(self):
        while self.running:
            {put}
        {last}

    def decode(self):
        while self.running:
            {get}

rclpy.init()
port = Port()
node = rclpy.create_node('port')
rclpy.spin_once(node)
port.running = False
{end}
"""
BOTH = 'port.reader.join()\nport.decoder.join()'
PUT, GETS = 'self.frames.put(input())', 'print(self.frames.get())'


@pytest.mark.parametrize(
    ('put', 'last', 'get', 'end', 'told'),
    [
        (PUT, 'pass', GETS, BOTH, MAY),
        (PUT, 'pass', GETS, 'port.decoder.join()', []),
        (PUT, 'pass', GETS, 'port.decoder.join()\nport.reader.join()', []),
        (PUT, 'pass', GETS, 'port.reader.join(1.0)\nport.decoder.join()', []),
        (PUT, 'pass', GETS, BOTH.replace('\n', '\nport.frames.put(None)\n'), []),
        (PUT, 'self.frames.put(None)', GETS, BOTH, []),
        # Its last item may be the one that says so.
        (PUT + '\n            if not self.running: break', 'pass', GETS, BOTH, []),
        (PUT, 'pass', 'if self.frames.get() is None: return', BOTH, []),
    ],
)
def test_a_join_after_the_thread_that_gives_has_ended(
    put: str, last: str, get: str, end: str, told: list[Severity]
) -> None:
    assert _joins(FED.format(put=put, last=last, get=get, end=end)) == told


def _joins(text: str) -> list[Severity]:
    """The severity of what is reported about joins."""
    found = scan_text(text).diagnostics
    return [each.severity for each in found if 'Thread.join' in each.message]


FINISHED = """
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

class Tour(Node):
    def __init__(self):
        super().__init__('tour')
        self.stop = threading.Event()
        self.finished = rclpy.Future()
        self.drive = self.create_client(Trigger, 'drive')
        self.create_subscription(Empty, 'stop', self.on_stop, 10)
        self.guide = threading.Thread(target=self.walk)
        self.guide.start()

    def on_stop(self, msg):
        self.stop.set()
        {heard}

    def walk(self):
        {first}
        while not self.stop.is_set():
            self.drive.call(Trigger.Request())
            {each}
        {last}

rclpy.init()
node = Tour()
executor = SingleThreadedExecutor()
executor.add_node(node)
executor.spin_once()
{spin}
node.guide.join()
"""
TELL = 'self.finished.set_result(True)'
UNTIL_FINISHED = 'executor.spin_until_future_complete(node.finished)'


@pytest.mark.parametrize(
    ('places', 'spin', 'told'),
    [
        ({'last': TELL}, UNTIL_FINISHED, []),
        # Who makes it done before may stand in its loop still.
        ({'first': TELL}, UNTIL_FINISHED, MAY),
        ({'each': TELL}, UNTIL_FINISHED, MAY),
        ({'last': TELL, 'heard': TELL}, UNTIL_FINISHED, MAY),
        ({'last': TELL}, 'executor.spin_until_future_complete(node.finished, 1.0)', MAY),
        ({'last': TELL}, f'if node.stop.is_set():\n    {UNTIL_FINISHED}', MAY),
    ],
)
def test_a_thread_that_has_told_of_its_end_is_joined_at_once(
    places: dict[str, str], spin: str, told: list[Severity]
) -> None:
    lines = dict.fromkeys(('first', 'each', 'last', 'heard'), 'print()') | places
    assert _joins(FINISHED.format(**lines, spin=spin)) == told


STEPS = """
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import String

class Waiter:
    def __init__(self):
        self.node = rclpy.create_node('waiter')
        self.seen = threading.Event()
        self.node.create_subscription(String, 'topic', self.heard, 10)
        {timer}
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.running = True
        self.thread = threading.Thread(target=self.spin)
        self.thread.start()

    def heard(self, msg):
        self.seen.set()

    def spin(self):
        while self.running:
            self.executor.spin_once({timeout})

def main():
    rclpy.init()
    waiter = Waiter()
    waiter.seen.wait(5.0)
    waiter.running = False
    {end}

main()
"""
TIMER = 'self.node.create_timer(1.0, self.seen.clear)'
JOINED, DOWN = 'waiter.thread.join()', 'rclpy.shutdown()'


@pytest.mark.parametrize(
    ('timer', 'timeout', 'end', 'told'),
    [
        ('', '', JOINED, 1),
        ('', 'timeout_sec=None', JOINED, 1),
        ('', 'timeout_sec=0.1', JOINED, 0),
        (TIMER, '', JOINED, 0),
        ('', '', f'waiter.executor.shutdown(); {JOINED}', 0),
        ('', '', f'{DOWN}; {JOINED}', 0),
        ('', '', f'{JOINED}; {DOWN}', 1),
    ],
)
def test_a_thread_that_steps_without_a_time_out(
    timer: str, timeout: str, end: str, told: int
) -> None:
    found = scan_text(STEPS.format(timer=timer, timeout=timeout, end=end)).diagnostics
    messages = [each.message for each in found if each.slug == 'nobody-spins']
    assert messages == told * [
        'Thread.join waits for a thread that waits in spin_once without a time-out '
        '(node.py:24:13) until something arrives: it may wait forever'
    ]
