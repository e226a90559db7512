"""Loops that wait for nothing: each way through the body leaves them, or each round ends them."""

from __future__ import annotations

import textwrap

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import copy
import threading
import time
from contextlib import suppress

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger
from grid_msgs.msg import Grid


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'state')
        self.ready = False
        self.lock = threading.Lock()
        self.grid = None
        self.create_subscription(Grid, 'grid', self.on_grid, 10)
        self.create_timer(1.0, self.tick)

    def on_grid(self, msg):
        self.grid = msg

    def tick(self):
        grid = copy.deepcopy(self.grid)
        grid.rows = list(grid.rows)
        self.future = self.client.call_async(Trigger.Request())
{loop}


def main():
    rclpy.init()
    rclpy.spin(Asker())
"""
ASKS = """
    try:
        answer = self.future.result()
    except Exception as error:
        self.get_logger().error(f'failed: {error}')
"""


def _calls(loop: str) -> list[str]:
    text = PROGRAM.format(loop=textwrap.indent(textwrap.dedent(loop).strip(), ' ' * 8))
    (unit,) = scan_text(text).units
    tick = next(each for each in unit.callbacks if each.name == 'tick')
    return [block.call for block in tick.blocking]


ONE_ROUND = [
    f'while not self.future.done():{ASKS}    break',
    f'while not self.ready:{ASKS}    return',
    'while not self.ready:\n    if self.future.done():\n        return\n    else:\n        break',
    'while not self.future.done():\n    with self.lock:\n        raise RuntimeError',
    'while not self.future.done():\n    try:\n        return\n    finally:\n        print()',
    'while not self.ready:\n    for each in range(3):\n        continue\n    break',
    'while len(grid.rows) < len(grid.names):\n    grid.rows.append(0.0)',
]
MORE_ROUNDS = [
    'while len(grid.rows) < 3:\n    if self.ready:\n        grid.rows.append(0.0)',
    'while not self.future.done():\n    if self.ready:\n        break',
    'while not self.future.done():\n    try:\n        return\n    except Exception:\n        pass',
    'while not self.ready:\n    if self.future.done():\n        continue\n    break',
    'while not self.future.done():\n    with suppress(ValueError):\n        return',
    'while not self.ready:\n    time.sleep(0.1)',
]


@pytest.mark.parametrize('loop', ONE_ROUND)
def test_one_round_waits_for_nobody(loop: str) -> None:
    assert _calls(loop) == []


@pytest.mark.parametrize('loop', MORE_ROUNDS)
def test_a_loop_that_may_go_round_waits(loop: str) -> None:
    assert _calls(loop) != []
