"""Who ends a wait may be there only because of a callback that cannot run meanwhile."""

from __future__ import annotations

import pytest

from tests.random_waits.suite import ENDS, UNDECIDED, judge

PROGRAM = """\
import threading
import queue
import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import Trigger
from rclpy.action import ActionServer, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Worker(Node):
    def __init__(self):
        super().__init__('worker')
        self.own = MutuallyExclusiveCallbackGroup()
        self.other = MutuallyExclusiveCallbackGroup()
        self.third = MutuallyExclusiveCallbackGroup()
        self.free = threading.Event()
        self.stock = queue.Queue()
{made}

{bodies}

rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Worker())
executor.spin()
"""
GOALS = """
ActionServer(self, Fibonacci, 'work', self.execute, goal_callback=self.on_goal,
             callback_group=self.own)
self.create_timer(0.1, self.tick, callback_group=self.{group})
"""
WAITS_FOR_A_GOAL = """
def on_goal(self, request):
    return GoalResponse.ACCEPT

def execute(self, goal):
    self.free.set()
    return Fibonacci.Result()

def tick(self):
    self.free.wait()
"""
WAITS_FOR_ITS_GOAL = """
def on_goal(self, request):
    self.free.wait()
    return GoalResponse.ACCEPT

def execute(self, goal):
    self.free.set()
    return Fibonacci.Result()

def tick(self):
    pass
"""
ANSWERS = """
self.client = self.create_client(Trigger, 'there', callback_group=self.third)
self.create_timer(0.1, self.asks, callback_group=self.own)
self.create_timer(0.1, self.waits, callback_group=self.{group})
"""
WAITS_FOR_AN_ANSWER = """
def asks(self):
    self.client.call_async(Trigger.Request()).add_done_callback(self.done)

def waits(self):
    self.free.wait()

def done(self, future):
    self.free.set()
"""
EVENT = """
self.free.set()
self.create_timer(0.1, self.takes, callback_group=self.own)
self.create_timer(0.1, self.gives, callback_group=self.own)
"""
TAKES_TURNS = """
def takes(self):
    self.free.wait()
    {}

def gives(self):
    self.free.set()
"""
STOCKED = """
for each in open('stock'):
    self.stock.put(each)
self.create_timer(0.1, self.takes, callback_group=self.own)
"""
TAKES = """
def takes(self):
    self.stock.get({})
"""


def indented(text: str, depth: int) -> str:
    return '\n'.join(' ' * depth + line for line in text.strip().splitlines())


def program(made: str, bodies: str) -> str:
    return PROGRAM.format(made=indented(made, 8), bodies=indented(bodies, 4))


@pytest.mark.parametrize(('group', 'verdict'), [('own', UNDECIDED), ('other', ENDS)])
def test_a_goal_is_executed_when_it_was_accepted(group: str, verdict: str) -> None:
    text = program(GOALS.format(group=group), WAITS_FOR_A_GOAL)
    assert judge(text)['tick'] == verdict


def test_no_goal_is_executed_before_its_goal_callback_has_ended() -> None:
    text = program(GOALS.format(group='other'), WAITS_FOR_ITS_GOAL)
    assert judge(text)['on_goal'] == UNDECIDED


@pytest.mark.parametrize(('group', 'verdict'), [('own', UNDECIDED), ('other', ENDS)])
def test_no_answer_comes_before_the_request(group: str, verdict: str) -> None:
    text = program(ANSWERS.format(group=group), WAITS_FOR_AN_ANSWER)
    assert judge(text)['waits'] == verdict


@pytest.mark.parametrize(('then', 'verdict'), [('self.free.clear()', UNDECIDED), ('pass', ENDS)])
def test_what_the_set_up_sets_may_be_cleared(then: str, verdict: str) -> None:
    text = program(EVENT, TAKES_TURNS.format(then))
    assert judge(text).get('takes', ENDS) == verdict


@pytest.mark.parametrize(('time_out', 'verdict'), [('', UNDECIDED), ('timeout=1.0', ENDS)])
def test_what_the_set_up_puts_is_used_up(time_out: str, verdict: str) -> None:
    text = program(STOCKED, TAKES.format(time_out))
    assert judge(text).get('takes', ENDS) == verdict
