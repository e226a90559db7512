"""A method of a library that is not scanned waits where its name says so."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import rclpy
from pymavlink import mavutil
from rclpy.node import Node

class Pilot(Node):
    def __init__(self):
        super().__init__('pilot')
        self.link = mavutil.mavlink_connection('/dev/ttyACM0')
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.link.CALL

rclpy.init()
rclpy.spin(Pilot())
"""


@pytest.mark.parametrize(
    ('call', 'waits'),
    [
        ('wait_heartbeat()', ['unknown wait']),
        ('wait_for_connection()', ['unknown wait']),
        ('wait_heartbeat(blocking=False)', []),
        ('recv(NOBLOCK)', ['unknown wait']),
        ('recv(mavutil.NOBLOCK)', []),
        ('recv_multipart(flags=mavutil.DONTWAIT)', []),
        ('accept()', []),
        ('accept()[0].close()', ['unknown wait']),
        ('waiting()', []),
        ('wait_count', []),
    ],
)
def test_what_is_called_a_wait_is_one(call: str, waits: list[str]) -> None:
    (unit,) = scan_text(PROGRAM.replace('CALL', call)).units
    assert [block.call for each in unit.callbacks for block in each.blocking] == waits


def test_a_number_is_its_time_out() -> None:
    (unit,) = scan_text(PROGRAM.replace('CALL', 'wait_for_connection(5)')).units
    assert [block.seconds for each in unit.callbacks for block in each.blocking] == [5]


@pytest.mark.parametrize('name', ['timeout', 'timeout_sec', 'time_to_wait'])
def test_a_time_out_has_several_names(name: str) -> None:
    (unit,) = scan_text(PROGRAM.replace('CALL', f'wait_for_service({name}=0.5)')).units
    assert [block.seconds for each in unit.callbacks for block in each.blocking] == [0.5]
