"""What a default leads to in one round of a loop says nothing of the others, or of other calls."""

from __future__ import annotations

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty


class Brake(Node):
    def __init__(self):
        super().__init__('brake')
        self.declare_parameter('count', 5)
        self.count = int(self.get_parameter('count').value)
        self.create_subscription(Empty, 'stop', self.on_stop, 10)
        self.create_subscription(Empty, 'halt', self.on_halt, 10)

    def on_stop(self, msg):
        self.brake()

    def on_halt(self, msg):
        self.brake()

    def brake(self):
        for index in range(self.count):
            if index + 1 < self.count:
                time.sleep(0.1)


rclpy.init()
rclpy.spin(Brake())
"""


def test_the_last_round_of_one_call_is_not_told_of_the_rounds_of_the_next() -> None:
    (unit,) = scan_text(PROGRAM).units
    sleeps = [[(b.times, b.only_if is None) for b in c.blocking] for c in unit.callbacks]
    assert sleeps == [[(4, True), (1, False)]] * 2
