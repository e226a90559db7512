"""A loop that counts what tasks of its own run do: those of runs that never come do not count."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

PROGRAM = """\
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.count = 0
        self.create_timer(0.05, self.tick, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.05, self.tock, callback_group=MutuallyExclusiveCallbackGroup())

    def tick(self):
        TICK
        while self.count < LEAST:
            time.sleep(0.01)

    def tock(self):
        TOCK

    async def work(self):
        self.count += 1

rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Waiter())
executor.spin()
"""
TASK = 'self.executor.create_task(self.work)'


@pytest.mark.parametrize(
    ('tick', 'tock', 'least', 'is_kept'),
    [
        (TASK, 'pass', 2, False),
        (TASK, 'pass', 1, True),
        ('pass', 'self.count += 1', 2, True),
    ],
)
def test_one_task_is_not_enough_for_two(
    tmp_path: Path, tick: str, tock: str, least: int, is_kept: bool
) -> None:
    text = PROGRAM.replace('TICK', tick).replace('TOCK', tock).replace('LEAST', str(least))
    (tmp_path / 'node.py').write_text(text)
    out = StringIO()
    main(
        ['check', '--no-cache', '--output-format', 'json', f'{tmp_path}/node.py'], out, StringIO()
    )
    found = json.loads(out.getvalue())['findings']
    codes = {each['code'] for each in found if each['code'].startswith('CC1')}
    assert (not codes) is is_kept
