"""A transform that ``can_transform`` has found is looked up at once."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import String
from tf2_ros import Buffer, TransformListener


class Follower(Node):
    def __init__(self):
        super().__init__('follower')
        self.buffer, self.more = Buffer(), Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_subscription(String, 'frame', self.on_frame, 10)

    def on_frame(self, msg):
        now = self.get_clock().now()
        if not self.buffer.can_transform('map', msg.data, {asked}):
            return
        print(self.{buffer}.lookup_transform({frames}, {time}, Duration(seconds=1.0)))


rclpy.init()
rclpy.spin(Follower())
"""
SAME = {'frames': "'map', msg.data", 'asked': 'Time()', 'time': 'Time()', 'buffer': 'buffer'}


def waits(**parts: str) -> list[str]:
    units = scan_text(PROGRAM.format(**SAME | parts)).units
    return [block.call for unit in units for each in unit.callbacks for block in each.blocking]


def test_the_same_question_is_no_wait() -> None:
    assert waits() == []
    assert waits(asked='now', time='now') == []


@pytest.mark.parametrize(
    'parts',
    [
        {'frames': "'map', 'base'"},
        {'frames': "'odom', msg.data"},
        {'buffer': 'more'},
        {'time': 'now'},
        {'time': 'Time(seconds=3)'},
        {'asked': 'self.get_clock().now()', 'time': 'self.get_clock().now()'},
    ],
)
def test_another_question_is_one(parts: dict[str, str]) -> None:
    assert waits(**parts) == ['Buffer.lookup_transform']
