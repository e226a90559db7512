"""A loop that asks for a service again after each time-out has none itself."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Bot(Node):
    def __init__(self):
        super().__init__('bot')
        self.go = self.create_client(Trigger, 'go')
        self.run = ActionClient(self, Fibonacci, 'run')
        self.create_timer(1.0, self.tick)

    def tick(self):
        {}


rclpy.init()
rclpy.spin(Bot())
"""
ASK = 'self.go.wait_for_service(timeout_sec=1.0)'


def seconds(does: str) -> list[object]:
    (unit,) = scan_text(PROGRAM.format(does.replace('\n', '\n        '))).units
    return [block.seconds for each in unit.callbacks for block in each.blocking]


@pytest.mark.parametrize(
    'does',
    [
        f'while not {ASK}:\n    self.get_logger().info("waiting")',
        f'while rclpy.ok() and not {ASK}:\n    pass',
        f'there = False\nwhile not there:\n    there = {ASK}',
        'while not self.run.wait_for_server(timeout_sec=1.0):\n    pass',
        'while not self.go.service_is_ready():\n    pass',
        'while not self.run.server_is_ready():\n    pass',
    ],
)
def test_it_goes_on_until_the_service_is_there(does: str) -> None:
    assert seconds(does) == [None]


@pytest.mark.parametrize(
    'does',
    [
        ASK,
        f'if not {ASK}:\n    return',
        f'while not {ASK}:\n    return',
        f'number = 0\nwhile not {ASK} and number < 5:\n    number += 1',
        f'while not {ASK}:\n    raise TimeoutError',
        f'there = False\nwhile not there:\n    there = {ASK}\n    there = True',
    ],
)
def test_one_that_may_end_otherwise_keeps_to_its_time_out(does: str) -> None:
    assert seconds(does) == [1.0]


def test_it_is_told_where_it_holds_the_only_thread() -> None:
    units = scan_text(PROGRAM.format(f'while not {ASK}:\n            pass')).units
    (finding,) = [each for each in findings_of(units, [], [None]) if each.code == 'CC204']
    assert finding.message == (
        'Bot.tick waits in wait_for_service for as long as it takes, on the only thread of the '
        "SingleThreadedExecutor: until service 'go' is there no other callback runs"
    )
