"""A pool of one thread runs in turn all that it is handed, in whatever way that is done."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import asyncio
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Pipeline(Node):
    def __init__(self):
        super().__init__('pipeline')
        self.loop = asyncio.new_event_loop()
        self.pool = ThreadPoolExecutor(max_workers={threads})
        self.create_subscription(String, 'text', self.on_text, 10)

    def on_text(self, message):
        self.pool.submit(self.process, message.data)

    def process(self, text):
        {hands_over}

    def clean(self, word):
        return word.strip()


rclpy.init()
rclpy.spin(Pipeline())
"""
WAYS = {
    'submit': 'self.pool.submit(self.clean, text).result()',
    'map': 'list(self.pool.map(self.clean, text.split()))',
    'run_in_executor': 'self.loop.run_in_executor(self.pool, self.clean, text).result()',
}


@pytest.mark.parametrize('hands_over', WAYS.values(), ids=WAYS)
@pytest.mark.parametrize(('threads', 'after'), [(1, None), (2, 0)])
def test_a_task_of_the_pool_begins_when_the_one_before_has_ended(
    hands_over: str, threads: int, after: int | None
) -> None:
    (unit,) = scan_text(PROGRAM.format(threads=threads, hands_over=hands_over)).units
    (cleaning,) = [each for each in unit.activities if each.name == 'clean']
    (started,) = cleaning.starts
    assert (started.by, started.after) == ('process_', after)
