"""Tasks of a pool that wait for tasks of the same pool, which then may get no thread."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import time
from concurrent.futures import ThreadPoolExecutor, wait
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Sorter(Node):
    def __init__(self):
        super().__init__('sorter')
        self.pool = ThreadPoolExecutor({workers})
        self.other = ThreadPoolExecutor({workers})
        self.create_subscription(Empty, 'box', self.on_box, 10)

    def on_box(self, msg):
        task = self.pool.submit(self.sort)
        {after}

    def sort(self):
        part = {pool}.submit(self.weigh)
        {waits}

    def weigh(self):
        time.sleep(0.1)

rclpy.init()
rclpy.spin(Sorter())
"""
PLAIN = {'workers': '2', 'pool': 'self.pool', 'waits': 'part.result()', 'after': 'pass'}
WHY = 'as many runs of sort at once as the pool has threads leave none for weigh'


def why(**changes: str) -> list[str | None]:
    (unit,) = scan_text(PROGRAM.format(**{**PLAIN, **changes})).units
    sort = next(each for each in unit.activities if each.name == 'sort')
    return [wait.escapes.reason if wait.escapes else None for wait in sort.blocking]


@pytest.mark.parametrize(
    'changes',
    [{}, {'workers': ''}, {'waits': 'wait([part])'}, {'after': 'task.add_done_callback(print)'}],
)
def test_who_would_end_the_wait_may_get_no_thread(changes: dict[str, str]) -> None:
    assert why(**changes) == [WHY]


@pytest.mark.parametrize(
    'changes',
    [
        {'pool': 'self.other'},
        # One thread is in the model: there they take turns.
        {'workers': '1'},
        {'after': 'task.result()'},
    ],
)
def test_else_it_is_not_open(changes: dict[str, str]) -> None:
    assert why(**changes) == [None]
