"""Flags and collections of a function that functions inside of it read and change."""

from __future__ import annotations

import pytest

from tests.random_waits.suite import ENDS, FOUND, UNDECIDED, judge

PROGRAM = """\
import time
import plant
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


def main():
    rclpy.init()
    node = rclpy.create_node('closed')
    other = {group}
    client = node.create_client(Trigger, 'ask', callback_group=other)
{bodies}
    node.create_timer(1.0, work)
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    executor.spin()


main()
"""
FLAG = """
done = False

def on_done(msg):
    nonlocal done
    done = True

def work():
    while not done:
        time.sleep(0.1)

node.create_subscription(Empty, 'done', on_done, 1, callback_group=other)
"""
LIST = """
done = [False]

def on_done(msg):
    done[0] = True

def work():
    while not done[0]:
        time.sleep(0.1)

node.create_subscription(Empty, 'done', on_done, 1, callback_group=other)
"""
DICTIONARY = """
state = dict(done=False)

def work():
    while rclpy.ok() and not state.get('done'):
        time.sleep(0.1)

node.create_subscription(
    Empty, 'done', lambda msg: state.update(done=True), 1, callback_group=other)
"""
ANSWERS = """
def work():
    done = False

    def on_answer(future):
        nonlocal done
        done = True

    client.call_async(Trigger.Request()).add_done_callback(on_answer)
    while not done:
        time.sleep(0.1)
"""
MADE_TWICE = """
def make(name, group):
    found = []

    def on_found(msg):
        found.append(msg)

    def wait():
        while not found:
            time.sleep(0.1)

    node.create_subscription(Empty, name, on_found, 1, callback_group=group)
    return wait

work = make('one', other)
make('two', MutuallyExclusiveCallbackGroup())
"""
UNCALLED = """
done = False

def on_done(msg):
    nonlocal done
    done = True

def work():
    while not done:
        time.sleep(0.1)

plant.connect(on_done)
"""
GIVEN = """
done = []
plant.connect(done)

def work():
    while not done:
        time.sleep(0.1)

def show():
    done.clear()
"""
GROUPS = {'own': 'None', 'other': 'MutuallyExclusiveCallbackGroup()'}


def judged(bodies: str, group: str = 'other') -> str:
    text = '\n'.join(f'    {line}'.rstrip() for line in bodies.strip().splitlines())
    verdicts = judge(PROGRAM.format(bodies=text, group=GROUPS[group]))
    return verdicts.get('work') or verdicts['wait']


@pytest.mark.parametrize('bodies', [FLAG, LIST, DICTIONARY, ANSWERS, MADE_TWICE])
@pytest.mark.parametrize(('group', 'verdict'), [('other', ENDS), ('own', FOUND)])
def test_a_loop_ends_where_its_writers_can_run(bodies: str, group: str, verdict: str) -> None:
    assert judged(bodies, group) == verdict


@pytest.mark.parametrize('bodies', [UNCALLED, GIVEN])
def test_what_unknown_code_may_write_is_open(bodies: str) -> None:
    assert judged(bodies) == UNDECIDED
