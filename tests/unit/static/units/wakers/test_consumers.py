"""A bounded queue that a thread empties by itself is never full forever."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import BY_ITSELF, TIME

PROGRAM = """
import queue
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Log(Node):
    def __init__(self):
        super().__init__('log')
        self.lines = queue.Queue(maxsize=2)
        self.acked = threading.Event()
        self.lock = threading.Lock()
        self.running = True
        self.create_subscription(String, 'line', self.on_line, 10)
        self.create_subscription(String, 'stop', self.on_stop, 10)
        {start}

    def on_line(self, msg):
        {put}

    def on_stop(self, msg):
        {stop}

    def write(self):
        while {loop}:
            line = self.lines.get()
            {work}

rclpy.init()
node = Log()
rclpy.spin(node)
node.lines.put(None)
"""
PLAIN = {
    'start': 'threading.Thread(target=self.write).start()',
    'put': 'self.lines.put(msg.data)',
    'stop': 'self.acked.set()',
    'loop': 'True',
    'work': 'time.sleep(0.1)',
}


def put(**changes: str) -> object:
    (unit,) = scan_text(PROGRAM.format(**{**PLAIN, **changes})).units
    on_line = next(each for each in unit.callbacks if each.name == 'on_line')
    wait = next(block for block in on_line.blocking if block.call == 'Queue.put')
    if wait.escapes is not None:
        return wait.escapes.reason
    return [waker.by for waker in wait.wakers]


@pytest.mark.parametrize(
    'changes',
    [
        {},
        {'loop': 'rclpy.ok()'},
        {'loop': 'self.running'},
        {'work': 'self.acked.wait(timeout=1.0)'},
        {'work': 'with self.lock:\n                pass'},
    ],
)
def test_who_waits_for_room_goes_on_by_itself(changes: dict[str, str]) -> None:
    assert put(**changes) == [TIME]


@pytest.mark.parametrize(
    'changes',
    [
        {'work': 'self.acked.wait()'},
        {'loop': 'self.running', 'stop': 'self.running = False'},
        {'stop': 'self.lines.put(None)'},
        {'loop': 'not self.acked.is_set()'},
        {
            'put': 'with self.lock:\n            self.lines.put(msg.data)',
            'work': 'with self.lock:\n                pass',
        },
    ],
)
def test_it_is_open_where_the_thread_may_be_held_up_or_over(changes: dict[str, str]) -> None:
    assert put(**changes) == f'the first 2 {BY_ITSELF}'


def test_so_it_is_where_it_is_not_known_whether_the_thread_runs() -> None:
    start = 'if input():\n            threading.Thread(target=self.write).start()'
    assert isinstance(put(start=start), str)


@pytest.mark.parametrize(
    ('start', 'is_none'),
    [
        ('threading.Thread(target=self.write).start()', True),
        ('threading.Thread(target=self.write).start()\n        self.lines.put(1)', False),
        ('threading.Thread(target=self.write).start()\n        serve(self.lines)', False),
    ],
)
def test_what_nobody_puts_in_is_never_found_there(start: str, is_none: bool) -> None:
    takes = 'if not self.lines.empty():\n            self.lines.get()'
    text = PROGRAM.replace('import String', 'import String\nfrom elsewhere import serve')
    text = text.replace('node.lines.put(None)', '')
    changes = {**PLAIN, 'start': start, 'put': takes, 'loop': 'not self.lines.empty()'}
    (unit,) = scan_text(text.format(**changes)).units
    on_line = next(each for each in unit.callbacks if each.name == 'on_line')
    calls = [block.call for block in on_line.blocking]
    assert calls == ([] if is_none else ['Queue.get'])
