"""Timer threads that arm themselves anew: nothing but a flag ends them for certain."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Beat(Node):
    def __init__(self):
        super().__init__('beat')
        self.lock = threading.Lock()
        self.active = True
        self.pub = self.create_publisher(Empty, 'beat', 10)
        self.create_subscription(Empty, 'stop', self.on_stop, 10)
        self.arm()

    def arm(self):
        self.timer = threading.Timer(0.5, self.beat)
        {daemon}
        self.timer.start()

    def beat(self):
        {work}
        {again}

    def on_stop(self, msg):
        self.active = False
        self.timer.cancel()

rclpy.init()
rclpy.spin(Beat())
"""
SLOW, FLAG = 'time.sleep(0.1)', 'if self.active:\n            self.arm()'
PLAIN = {'daemon': 'pass', 'work': SLOW, 'again': 'self.arm()'}


def told(**changes: str) -> list[tuple[str, int | None]]:
    found = scan_text(PROGRAM.format(**{**PLAIN, **changes})).diagnostics
    return [(each.slug, each.place.line) for each in found if 'restarts itself' in each.message]


def test_a_cancel_may_come_while_the_function_runs() -> None:
    assert told() == [('nobody-spins', 24)]


@pytest.mark.parametrize(
    'changes',
    [
        {'again': FLAG},
        {'again': f'with self.lock:\n            {FLAG.replace("  ", "    ")}'},
        {'work': 'if not self.active:\n            return'},
        {'daemon': 'self.timer.daemon = True'},
        {'work': 'self.pub.publish(Empty())'},
        {'again': 'pass'},
    ],
)
def test_what_ends_is_not_told(changes: dict[str, str]) -> None:
    assert told(**changes) == []
