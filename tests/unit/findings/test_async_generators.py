"""Asynchronous generators and named tuples that do nothing wrong are followed without a word."""

from __future__ import annotations

from ros2cc_extract.extract.static.api import scan_text

NODE = """
import asyncio
from typing import NamedTuple
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Step(NamedTuple):
    name: str
    seconds: float = 1.0

    def label(self):
        return f'{self.name} {self.seconds}'

class Table(dict):
    def __missing__(self, key):
        return 0

class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.steps = [Step('a'), Step('b', 2.0)]
        self.table = Table()
        self.create_timer(1.0, self.on_timer)

    def on_timer(self):
        asyncio.run(self.go())

    async def items(self):
        for step in self.steps:
            await asyncio.sleep(0)
            yield step

    async def go(self):
        async for step in self.items():
            name, seconds = step
            self.get_logger().info(step.label() + str(self.table[name]))
        async with asyncio.TaskGroup() as group:
            one = group.create_task(self.work())
            group.create_task(self.work())
        self.get_logger().info(f'{one.result()} {await anext(self.items())}')

    async def work(self):
        await asyncio.sleep(0.01)
        return 1

rclpy.init()
rclpy.spin(Planner())
"""


def test_nothing_is_said_of_what_ends() -> None:
    scan = scan_text(NODE)
    (unit,) = scan.units
    assert not unit.set_up
    assert not scan.diagnostics
    calls = {block.call for each in unit.callbacks for block in each.blocking}
    assert calls <= {'yield', 'await asyncio.sleep', 'asyncio.sleep'}
    assert not any(block.escapes for each in unit.callbacks for block in each.blocking)
