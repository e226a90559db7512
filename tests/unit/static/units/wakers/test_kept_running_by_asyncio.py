"""A main program that asyncio runs beside a spinning thread waits for the signal that ends it."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import OUTSIDE
from ros2cc_extract.spec.model import ActivityKind

PROGRAM = """
import asyncio
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Hub(Node):
    def __init__(self):
        super().__init__('hub')
        self.create_subscription(String, 'lines', self.on_line, 10)

    def on_line(self, msg):
        pass

def main():
    rclpy.init()
    threading.Thread(target=rclpy.spin, args=(Hub(),), daemon=True).start()
    async def serve():
        {wait}
    asyncio.run(serve())

main()
"""


@pytest.mark.parametrize(
    'wait',
    [
        'await asyncio.Future()',
        'await asyncio.get_running_loop().create_future()',
        'await asyncio.Event().wait()',
    ],
)
def test_who_keeps_a_program_running_waits_for_the_signal(wait: str) -> None:
    """CPython 3.12, ``asyncio/runners.py``: SIGINT cancels the main task."""
    units = scan_text(PROGRAM.format(wait=wait)).units
    (main,) = (a for unit in units for a in unit.activities if a.kind is ActivityKind.MAIN)
    assert [[waker.by for waker in block.wakers] for block in main.blocking] == [[OUTSIDE]]
