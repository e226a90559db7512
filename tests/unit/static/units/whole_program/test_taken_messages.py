"""Waits for a message whose node somebody spins, who may take the message first."""

from __future__ import annotations

import textwrap

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Empty

class Planner(Node):
    def __init__(self, group=None):
        super().__init__('planner')
        self.create_timer(1.0, self.tick, callback_group=group)

    def tick(self):
        TICKS

    def load(self):
        wait_for_message(Empty, self, 'map')

class Other(Node):
    def __init__(self, node):
        super().__init__('other')
        self.node = node
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.node.load()

def main():
    rclpy.init()
    DOES

main()
"""
SPUN = 'threading.Thread(target=rclpy.spin, args=(node,)).start()'
WAITS = "wait_for_message(Empty, node, 'map')"
NODE = 'node = Planner()'
POOL = 'executor = MultiThreadedExecutor(num_threads=2)'


def told(does: str, ticks: str = 'pass') -> list[str]:
    body = textwrap.indent(does, ' ' * 4).strip()
    text = PROGRAM.replace('DOES', body).replace('TICKS', ticks)
    return [each.message for each in scan_text(text).diagnostics if each.slug == 'message-taken']


def pool(group: str, number: int = 2) -> str:
    node = f'node = Planner({group})'
    made = f'executor = MultiThreadedExecutor({number})'
    return f'{node}\n{made}\nexecutor.add_node(node)\nexecutor.spin()'


@pytest.mark.parametrize(
    'does',
    [
        f'{NODE}\n{SPUN}\n{WAITS}',
        f'{NODE}\n{SPUN}\nfor number in range(3):\n    node.load()',
        f'{NODE}\n{SPUN}\nwait_for_message(Empty, node, "map", time_to_wait=1.0)',
        f'{NODE}\nthreading.Thread(target=node.load).start()\nrclpy.spin(node)',
        f'{NODE}\nother = Other(node)\n{SPUN}\nexecutor = SingleThreadedExecutor()\n'
        'executor.add_node(other)\nexecutor.spin()',
    ],
)
def test_who_spins_the_node_may_take_what_another_thread_waits_for(does: str) -> None:
    assert len(told(does)) == 1


@pytest.mark.parametrize(
    'does',
    [
        f'{NODE}\n{WAITS}\n{SPUN}',
        f"{NODE}\n{SPUN}\nnode = rclpy.create_node('other')\n{WAITS}",
        f'{NODE}\nthread = threading.Thread(target=node.load)\nthread.start()\nthread.join()\n'
        'rclpy.spin(node)',
        f'{NODE}\nthread = threading.Thread(target=rclpy.spin, args=(node,))\nthread.start()\n'
        f'rclpy.shutdown()\nthread.join()\n{WAITS}',
        f'{NODE}\n{WAITS}\nrclpy.spin(node)',
    ],
)
def test_a_node_that_nobody_spins_then_gets_its_message(does: str) -> None:
    assert told(does) == []


@pytest.mark.parametrize(
    ('does', 'number'),
    [
        (pool('MutuallyExclusiveCallbackGroup()'), 1),
        (pool('ReentrantCallbackGroup()'), 1),
        (pool(''), 0),
        (pool('ReentrantCallbackGroup()', 1), 0),
        (f'{NODE}\nrclpy.spin(node)', 0),
    ],
)
def test_a_callback_is_robbed_where_the_pool_runs_the_default_group(
    does: str, number: int
) -> None:
    assert len(told(does, 'self.load()')) == number


def test_what_becomes_of_it_rests_on_the_limit() -> None:
    (without,) = told(f'{NODE}\n{SPUN}\n{WAITS}')
    assert without.endswith('returns False, or waits for the next one, forever if none comes')
    (with_one,) = told(f'{NODE}\n{SPUN}\nwait_for_message(Empty, node, "map", time_to_wait=1.0)')
    assert with_one.endswith('returns False')
