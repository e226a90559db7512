"""The set-up waits for a thread that waits for callbacks, and nothing is spun yet."""

from __future__ import annotations

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.source_locations import Unknown

PROGRAM = """
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Bridge(Node):
    def __init__(self):
        super().__init__('bridge')
        self.client = self.create_client(Trigger, 'start')
        self.action = ActionClient(self, Fibonacci, 'fib')
        self.done = threading.Event()
        self.heard = threading.Event()
        self.create_subscription(Empty, 'go', lambda m: self.heard.set(), 1)
        {set_up}

    def begin(self):
        {begin}

    def behind(self):
        first = threading.Thread(target=self.begin)
        first.start()
        first.join()


rclpy.init()
node = Bridge()
{main}
"""
SPIN = 'rclpy.spin(node)'
CALL = 'self.client.call(Trigger.Request())'
SET = '\n        self.done.set()'
THREAD = 'threading.Thread(target=self.begin)\n        worker.start()\n        '
JOIN = f'worker = {THREAD}worker.join()'
EVENT = f'worker = {THREAD}self.done.wait()'
RESULT = 'ThreadPoolExecutor(1).submit(self.begin).result()'
WITH = 'with ThreadPoolExecutor() as pool:\n            pool.submit(self.begin)'
BEHIND = JOIN.replace('self.begin', 'self.behind')
WAITS = {
    CALL: 'client.call for start_client',
    'self.action.send_goal(Fibonacci.Goal())': 'send_goal for fib_action_client',
    'f = self.client.call_async(Trigger.Request())\n        while not f.done():\n'
    '            time.sleep(0.1)': 'a busy loop for start_client',
    'self.heard.wait()': 'Event.wait for heard',
}
ENDS = {
    JOIN: 'Thread.join',
    EVENT: 'Event.wait',
    RESULT: 'Future.result',
    WITH: 'Executor.shutdown',
}


def told(set_up: str, begin: str, main: str = SPIN) -> list[tuple[Severity, str]]:
    scan = scan_text(PROGRAM.format(set_up=set_up, begin=begin + SET, main=main))
    return [(d.severity, d.message) for d in scan.diagnostics if d.slug == 'nobody-spins']


@pytest.mark.parametrize('set_up', ENDS)
@pytest.mark.parametrize('begin', WAITS)
def test_the_thread_gets_no_answer_before_the_spin(set_up: str, begin: str) -> None:
    ((severity, message),) = told(set_up, begin)
    assert severity is Severity.ERROR
    assert f'waits in {WAITS[begin]} (' in message
    assert message.startswith(f'{ENDS[set_up]} waits for ')
    assert message.endswith(
        'and nothing spins the node whose callback would end that meanwhile: it waits forever'
    )


def test_a_thread_that_waits_for_such_a_thread_is_one() -> None:
    ((severity, message),) = told(BEHIND, CALL)
    assert severity is Severity.ERROR
    assert message.startswith(
        'Thread.join waits for thread behind, which itself waits in Thread.join for first ('
    )


@pytest.mark.parametrize(
    ('set_up', 'begin', 'main'),
    [
        ('worker = ' + THREAD, CALL, SPIN),
        (EVENT, 'self.done.set()\n        ' + CALL, SPIN),
        (JOIN, 'self.heard.wait(1.0)', SPIN),
        (JOIN, 'rclpy.spin_until_future_complete(self, self.client.call_async(None))', SPIN),
        (
            'pass',
            CALL,
            'threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n'
            'worker = threading.Thread(target=node.begin)\nworker.start()\nworker.join()',
        ),
    ],
    ids=['nobody waits', 'set before', 'for some time', 'it spins itself', 'another thread spins'],
)
def test_else_it_is_not_said(set_up: str, begin: str, main: str) -> None:
    assert told(set_up, begin, main) == []


@pytest.mark.parametrize(
    ('set_up', 'begin'),
    [
        (f'if self.count_publishers("y"):\n            {WITH}', CALL),
        (JOIN, f'if not self.client.wait_for_service(1.0):\n            return\n        {CALL}'),
    ],
    ids=['of the set-up', 'of the thread'],
)
def test_behind_a_branch_it_is_undecided(set_up: str, begin: str) -> None:
    set_up = set_up.replace('\n            pool', '\n                pool')
    scan = scan_text(PROGRAM.format(set_up=set_up, begin=begin + SET, main=SPIN))
    assert [d.slug for d in scan.diagnostics if d.slug == 'nobody-spins'] == []
    (unit,) = scan.units
    reasons = {each.escapes.reason for each in unit.set_up if isinstance(each.escapes, Unknown)}
    assert reasons == {
        'thread begin itself waits in client.call, and no known code spins node meanwhile'
    }
