"""A function that is stored and looked up under a name in the same words is that function."""

from __future__ import annotations

from ros2cc_extract.extract.static.api import scan_text

NODE = """
import functools
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Relay(Node):
    def __init__(self):
        super().__init__('relay')
        for topic in open('topics'):
            setattr(self, f'on_{topic}', functools.partial(self.on_any, topic))
            self.create_subscription(String, topic, getattr(self, f'on_{topic}'), 10)
        for name in ('speed', 'turn'):
            setattr(self, name, self.declare_parameter(name, 1.0).value)
        self.create_timer(1.0, self.on_timer)

    def on_any(self, topic, msg):
        self.last = topic

    def on_timer(self):
        self.log_all()

    def log_all(self):
        self.get_logger().info(f'{self.last} {self.speed}')

rclpy.init()
rclpy.spin(Relay())
"""


def test_no_method_of_such_a_name_is_meant() -> None:
    scan = scan_text(NODE)
    (unit,) = scan.units
    assert not scan.diagnostics
    assert {each.function_name for each in unit.callbacks} == {'on_any', 'on_timer'}
    assert not any(each.blocking for each in unit.callbacks)
