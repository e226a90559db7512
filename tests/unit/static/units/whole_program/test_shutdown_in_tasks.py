"""
``rclpy.shutdown`` on Humble waits for what the executor does with an entity, and for no task.

Observed with the executor of 3.3.21: in a timer it hangs, in a done-callback of a call it ends.
"""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Brief(Node):
    def __init__(self):
        super().__init__('brief')
        self.client = self.create_client(Trigger, 'go')
        self.over = Future()
        self.over.add_done_callback(self.done)
        self.timer = self.create_timer(1.0, self.tick)

    def tick(self):
        {tick}

    def done(self, future):
        {done}


rclpy.init()
rclpy.spin(Brief())
"""
ASK = 'self.client.call_async(Trigger.Request()).add_done_callback(self.done)'
TRY = 'try:\n            self.timer.shutdown()\n        except AttributeError:\n            {}'


def told(tick: str, done: str = 'pass') -> list[str]:
    return [each.slug for each in scan_text(PROGRAM.format(tick=tick, done=done)).diagnostics]


@pytest.mark.parametrize(
    ('tick', 'done'),
    [
        ('rclpy.shutdown()', 'pass'),
        ('self.over.set_result(1)', 'rclpy.shutdown()'),  # runs within the timer's callback
        (TRY.format('rclpy.shutdown()'), 'pass'),
    ],
)
def test_a_callback_of_an_entity_waits_for_itself(tick: str, done: str) -> None:
    assert told(tick, done) == ['shut-down-in-callback']


def test_a_done_callback_of_a_call_does_not() -> None:
    assert told(ASK, 'rclpy.shutdown()') == []


def test_behind_a_method_that_timers_have_not_nothing_runs() -> None:
    assert told('self.timer.shutdown()\n        rclpy.shutdown()') == []


@pytest.mark.parametrize(
    ('limit', 'slug'),
    [('', 'shut-down-in-callback'), ('-1', 'shut-down-in-callback'), ('0.1', 'served-no-more')],
)
def test_a_shutdown_with_a_limit_goes_on(limit: str, slug: str) -> None:
    """The executor ends all the same."""
    text = PROGRAM.format(tick=f'self.executor.shutdown({limit})', done='pass')
    own = 'executor = rclpy.executors.SingleThreadedExecutor()\nexecutor.add_node(Brief())\n'
    text = text.replace('rclpy.spin(Brief())\n', f'{own}executor.spin()\n')
    assert [each.slug for each in scan_text(text).diagnostics] == [slug]
