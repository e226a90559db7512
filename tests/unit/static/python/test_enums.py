"""Members of enumerations are constants."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
from enum import Enum, IntEnum, auto
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Mode(Enum):
    OFF = 0
    SYNC = 'sync'
    ALSO = 'sync'
    FIRST = auto()

class Level(IntEnum):
    LOW = auto()
    HIGH = auto()

class Asker(Node):
    def __init__(self, mode={mode}):
        super().__init__('asker')
        self.mode = mode
        self.create_timer(1.0, self.one if {test} else self.other)

    def one(self):
        pass

    def other(self):
        pass

rclpy.init()
rclpy.spin(Asker())
"""


@pytest.mark.parametrize(
    ('mode', 'test', 'called'),
    [
        ('Mode.SYNC', 'self.mode is Mode.SYNC', ['one']),
        ('Mode.SYNC', 'self.mode is Mode.ALSO', ['one']),
        ('Mode.SYNC', 'self.mode == Mode.FIRST', ['other']),
        ('Mode.FIRST', 'self.mode != Mode.FIRST', ['other']),
        ('Mode.OFF', 'self.mode', ['one']),
        ('Mode.SYNC', "self.mode == 'sync'", ['other']),
        ('Mode.SYNC', "self.mode.value == 'sync'", ['one']),
        ('Mode.SYNC', "self.mode.name == 'SYNC'", ['one']),
        ("Mode('sync')", 'self.mode is Mode.SYNC', ['one']),
        ('Mode(input())', 'self.mode is Mode.SYNC', ['one_or_other']),
        ('Level.LOW', 'self.mode == 1', ['one']),
        ('Level.LOW', 'self.mode < Level.HIGH', ['one']),
    ],
)
def test_what_a_test_of_a_member_decides(mode: str, test: str, called: list[str]) -> None:
    (unit,) = scan_text(PROGRAM.format(mode=mode, test=test)).units
    assert [each.name for each in unit.callbacks] == called
