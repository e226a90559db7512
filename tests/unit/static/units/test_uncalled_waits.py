"""Waits of methods that no known code calls, as handlers of pages and keys, are reported."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import subprocess
import threading
import keys
import rclpy
from flask import Flask
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

app = Flask(__name__)

class Seen:
    pose = None

    def __init__(self, node):
        node.create_subscription(Empty, 'pose', self.on_pose, 10)

    def on_pose(self, msg):
        self.pose = msg

class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.seen = Seen(self)
        self.home = self.create_client(Trigger, 'home')
        self.pressed = keys.Pressed()
        self.worker = threading.Thread(target=print)
        self.worker.start()

    def act(self):
        WAIT

HANDED
if __name__ == '__main__':
    rclpy.init()
    robot = Robot()
    threading.Thread(target=rclpy.spin, args=(robot,), daemon=True).start()
    LAST
"""
ROUTE = """\
@app.route('/act')
def act():
    robot.act()
"""


def waits(wait: str, handed: str, last: str) -> list[str]:
    text = PROGRAM.replace('WAIT', wait).replace('HANDED', handed).replace('LAST', last)
    (unit,) = scan_text(text).units
    return [each.call for each in unit.set_up]


@pytest.mark.parametrize(
    ('handed', 'last'),
    [
        (ROUTE, 'app.run()'),
        ('', "keys.Commander([('a', robot.act)])"),
        ('', 'input()'),
    ],
)
@pytest.mark.parametrize(
    ('wait', 'call'),
    [
        ('self.home.call(Trigger.Request())', 'client.call'),
        ('self.home.wait_for_service()', 'wait_for_service'),
        ('self.worker.join()', 'Thread.join'),
        ('self.pressed.wait_for_a_key()', 'unknown wait'),
        ("subprocess.run(['gcc'])", 'subprocess.run'),
        ('if self.seen.pose:\n            self.home.call(Trigger.Request())', 'client.call'),
    ],
)
def test_they_are_in_the_specification(handed: str, last: str, wait: str, call: str) -> None:
    assert call in waits(wait, handed, last)


def test_what_does_not_wait_is_not() -> None:
    assert waits("', '.join(['a'])", ROUTE, 'app.run()') == []
