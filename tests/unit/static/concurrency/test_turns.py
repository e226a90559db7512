"""Coroutines that let the executor run others, and go on by themselves."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """
import asyncio, time
import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Empty
from test_msgs.action import Fibonacci

class Turn:
    def __await__(self):
        yield

class Of:
    def __init__(self, future):
        self.future = future

    def __await__(self):
        yield self.future

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.arrived = False
        self.found = Future()
        self.create_subscription(Empty, 'arrived', self.on_arrived, 1)
        self.server = ActionServer(self, Fibonacci, 'move', self.execute)

    def on_arrived(self, msg):
        self.arrived = True
        self.found.set_result(True)

    async def execute(self, goal):
        {text}

rclpy.init()
rclpy.spin(Arm())
"""
STEPS = 'while not goal.is_cancel_requested:\n            time.sleep(0.1)\n            {}'
UNTIL = 'while not self.arrived:\n            {}'


@pytest.mark.parametrize(
    ('turn', 'told'),
    [
        ('await asyncio.sleep(0)', []),
        ('await Turn()', []),
        ('await asyncio.sleep(0.1)', ['CC108', 'CC203']),
        ('pass', ['CC203']),
    ],
)
def test_a_cancel_request_is_taken_where_an_execute_callback_gives_way(
    turn: str, told: list[str]
) -> None:
    found = findings_of(scan_text(PROGRAM.format(text=STEPS.format(turn))).units, [], [None])
    assert sorted(each.code for each in found if each.code in ('CC108', 'CC203')) == told


@pytest.mark.parametrize(
    ('text', 'waits'),
    [
        (UNTIL.format('await asyncio.sleep(0)'), ['yield', 'await on_arrived']),
        (UNTIL.format('await Turn()'), ['yield', 'await on_arrived']),
        (UNTIL.format('time.sleep(0.1)'), ['time.sleep', 'polling loop on_arrived']),
        ('await Turn()', ['yield']),
        ('await Of(self.found)', ['await on_arrived']),
    ],
)
def test_who_gives_way_in_each_round_awaits(text: str, waits: list[str]) -> None:
    (unit,) = scan_text(PROGRAM.format(text=text)).units
    (execute,) = [each for each in unit.callbacks if each.name == 'execute']
    assert [f'{b.call} {b.on or ""}'.strip() for b in execute.blocking] == waits
