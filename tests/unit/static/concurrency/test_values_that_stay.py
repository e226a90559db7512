"""A write after which the loop goes on all the same does not end it."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.concurrency.machine.loop_formulas import Formula, LoopTest
from tests.random_waits.suite import ENDS, FOUND, UNDECIDED, judge

PROGRAM = """\
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.done, self.pose, self.mode, self.count = False, None, 'idle', 0
        self.state = {{'a': False, 'b': False}}
        other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Empty, 'go', self.on_go, 10, callback_group=other)
        self.create_timer(1.0, self.work)

    def on_go(self, msg):
        {write}

    def work(self):
        {loop}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Waiter())
executor.spin()
"""
SLEEPS = ':\n            time.sleep(0.1)'
BREAKS = 'while True:\n            if {}:\n                break\n            time.sleep(0.1)'


def judged(test: str, write: str) -> str:
    loop = test if test.startswith('while') else f'while {test}{SLEEPS}'
    return judge(PROGRAM.format(write=write, loop=loop))['work']


@pytest.mark.parametrize(
    ('test', 'write'),
    [
        ('not self.done', 'self.done = False'),
        ('rclpy.ok() and not self.done', 'self.done = False'),
        ('self.pose is None', 'self.pose = None'),
        ("self.mode != 'ready'", "self.mode = 'idle'"),
        ("not self.state['a']", "self.state['b'] = True"),
        ("not self.state['a']", "self.state['a'] = False"),
        ("not self.state['a']", 'self.state.update(b=True)'),
        (BREAKS.format('self.done'), 'self.done = False'),
        ('not (self.done and self.pose)', 'self.pose = None'),
    ],
)
def test_nothing_ends_it(test: str, write: str) -> None:
    assert judged(test, write) == FOUND


@pytest.mark.parametrize(
    ('test', 'write'),
    [
        ('not self.done', 'self.done = True'),
        ('not self.done', 'for value in (False, True):\n            self.done = value'),
        ('self.pose is None', 'self.pose = 0'),
        ("self.mode != 'ready'", "self.mode = 'ready'"),
        ("self.mode == 'idle'", "self.mode = 'ready'"),
        ("not self.state['a']", "self.state['a'] = True"),
        ("not self.state['a']", 'self.state.update(a=True)'),
        ("not self.state['a']", 'self.state.update(b=True, c=True)'),
        ('not any(self.state.values())', "self.state['b'] = True"),
        (BREAKS.format('not self.mode'), "self.mode = ''"),
        ('self.count < 1', 'self.count += 1'),
        ('not (self.done or self.pose)', 'self.done = True'),
    ],
)
def test_the_write_may_end_it(test: str, write: str) -> None:
    assert judged(test, write) == ENDS


BOTH = """\
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.left, self.right, self.enabled = False, False, True
        other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Empty, 'left', self.on_left, 10, callback_group=other)
        self.create_subscription(Empty, 'right', self.on_right, 10, callback_group={group})
        self.create_timer(1.0, self.work)

    def on_left(self, msg):
        self.left = True

    def on_right(self, msg):
        self.right = True

    def work(self):
        while {test}:
            time.sleep(0.1)


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Waiter())
executor.spin()
"""


@pytest.mark.parametrize(('group', 'verdict'), [('other', ENDS), ('None', FOUND)])
@pytest.mark.parametrize(
    'test',
    [
        'not (self.left and self.right)',
        'not self.left or not self.right',
        'rclpy.ok() and not (self.left and self.right)',
        'not (self.enabled and self.left and self.right)',
        'not all((self.left, self.right))',
        "not all(getattr(self, name) for name in ('left', 'right'))",
        "not getattr(self, 'right')",
    ],
)
def test_all_that_a_loop_asks_for_must_come(test: str, group: str, verdict: str) -> None:
    assert judge(BOTH.format(test=test, group=group))['work'] == verdict


@pytest.mark.parametrize(('group', 'verdict'), [('other', ENDS), ('None', FOUND)])
@pytest.mark.parametrize(
    'test',
    [
        'not all(self.came.values())',
        'not all(each for each in self.came.values())',
        "not (self.came['left'] and self.came['right'])",
    ],
)
def test_all_items_of_a_dictionary_must_come(test: str, group: str, verdict: str) -> None:
    text = BOTH.format(test=test, group=group).replace('self.left', "self.came['left']")
    text = text.replace('self.right =', "self.came['right'] =")
    made = "super().__init__('waiter')"
    kept = f"{made}\n        self.came = {{'left': False, 'right': False}}"
    assert made in text
    assert judge(text.replace(made, kept))['work'] == verdict


def test_one_of_several_is_enough_where_the_loop_asks_for_any() -> None:
    assert judge(BOTH.format(test='not (self.left or self.right)', group='None'))['work'] == ENDS


def test_open_parts_may_have_any_result_by_which_the_loop_went_on() -> None:
    asked, other = Formula('asked', name='a'), Formula('open')
    both = LoopTest(Formula('and', (other, Formula('not', (asked,)))), stays_if=True)
    either = LoopTest(Formula('or', (other, Formula('not', (asked,)))), stays_if=True)
    assert both.stays('a', None, False)
    assert not both.stays('a', None, True)
    assert not either.stays('a', None, True)
    assert not LoopTest(asked, stays_if=None).stays('a', None, False)


@pytest.mark.parametrize(
    ('test', 'verdict'),
    [
        ('len(self.came) < 2', UNDECIDED),
        ('None in self.came.values()', UNDECIDED),
        ('len(self.came) == 0', ENDS),
        ('not self.came', ENDS),
    ],
)
def test_where_each_brings_its_part_one_may_not_be_enough(test: str, verdict: str) -> None:
    text = BOTH.format(test=test, group='other').replace('self.left', "self.came['left']")
    text = text.replace('self.right =', "self.came['right'] =")
    made = "super().__init__('waiter')"
    text = text.replace(made, f'{made}\n        self.came = {{}}')
    text = text.replace("self.came['left'], self.right, self.enabled = False, False, True", 'pass')
    assert judge(text)['work'] == verdict
