"""A lock that one callback takes and another one gives back is a signal, not a lock."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of
from tests.random_waits.suite import ENDS, FOUND, judge

PROGRAM = """\
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.own = MutuallyExclusiveCallbackGroup()
        self.other = MutuallyExclusiveCallbackGroup()
        self.third = MutuallyExclusiveCallbackGroup()
        self.answered = threading.Lock()
        self.client = self.create_client(Trigger, 'ask', callback_group=self.{group})
        self.create_service(Trigger, 'ask', self.on_ask, callback_group=self.third)
        self.create_subscription(Empty, 'go', self.on_go, 1, callback_group=self.{group})
        self.create_timer(0.5, self.work, callback_group=self.own)

    def on_ask(self, request, response):
        return response

{bodies}

rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Asker())
executor.spin()
"""
ANSWER = """
def work(self):
    self.answered.acquire()
    self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)
    self.answered.acquire()
    self.answered.release()

def on_answer(self, future):
    self.answered.release()

def on_go(self, msg):
    pass
"""
TWICE = """
def work(self):
    self.answered.acquire()
    self.answered.acquire()

def on_go(self, msg):
    self.answered.release()
"""
IN_ITSELF = """
def work(self):
    with self.answered:
        self.show()

def show(self):
    with self.answered:
        print('shown')

def on_go(self, msg):
    with self.answered:
        print('went')
"""
KEPT = """
def work(self):
    self.answered.acquire()
    if not self.client.service_is_ready():
        self.answered.release()
        return
    self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)

def on_answer(self, future):
    self.answered.release()

def on_go(self, msg):
    pass
"""
BUSY = """
def work(self):
    if not self.answered.acquire(blocking=False):
        return
    self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)

def on_answer(self, future):
    self.answered.release()

def on_go(self, msg):
    pass
"""


def program(bodies: str, group: str = 'other') -> str:
    text = '\n'.join(f'    {line}'.rstrip() for line in bodies.strip().splitlines())
    return PROGRAM.format(bodies=text, group=group)


def orders(text: str) -> list[int]:
    """The lines of which it is said that a lock is waited for by its own holder."""
    found = findings_of(scan_text(text).units, [], [None])
    return [each.place.line for each in found if each.code == 'CC111']


@pytest.mark.parametrize('bodies', [ANSWER, TWICE, BUSY])
def test_its_holder_waits_for_what_others_give(bodies: str) -> None:
    assert orders(program(bodies)) == []


def test_a_lock_that_all_give_back_themselves_is_a_lock() -> None:
    assert len(orders(program(IN_ITSELF))) == 1


@pytest.mark.parametrize(('group', 'verdict'), [('other', ENDS), ('own', FOUND)])
def test_it_ends_where_those_can_run_that_give_it(group: str, verdict: str) -> None:
    assert judge(program(ANSWER, group))['work'] == verdict


@pytest.mark.parametrize('kind', ['Lock', 'Semaphore'])
def test_whoever_takes_it_may_leave_it_to_others_to_give_it_back(kind: str) -> None:
    text = program(KEPT).replace('threading.Lock', f'threading.{kind}')
    kept = [each for each in scan_text(text).diagnostics if each.slug == 'lock-kept']
    assert kept == []


def test_what_is_taken_only_where_it_is_free_is_no_wait() -> None:
    (unit,) = scan_text(program(BUSY)).units
    work = next(each for each in unit.callbacks if each.name == 'work')
    assert [block for block in work.blocking if 'acquire' in block.call] == []
