"""CC301: an attribute is data where a method replaces it, whatever object lies in it."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import queue
import subprocess
import threading
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

class Player(Node):
    def __init__(self):
        super().__init__('player')
        group = ReentrantCallbackGroup()
        self.make()
        self.create_service(Trigger, 'start', self.on_start, callback_group=group)
        self.create_service(Trigger, 'again', self.on_again, callback_group=group)

    def make(self):
        self.held = MADE

    def on_start(self, request, response):
        if self.held.ASKED:
            self.get_logger().info('starting')
            self.held = MADE
        return response

    def on_again(self, request, response):
        AGAIN
        return response

    def tick(self):
        pass

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Player())
executor.spin()
"""
KINDS = [
    ('subprocess.Popen(["true"])', 'poll() is not None'),
    ('threading.Thread(target=print)', 'is_alive()'),
    ('threading.Event()', 'is_set()'),
    ('queue.Queue()', 'empty()'),
    ('self.create_timer(1.0, self.tick)', 'is_canceled()'),
    ('self.create_publisher(Empty, "out", 1)', 'get_subscription_count()'),
]


def warned(text: str) -> list[tuple[str, int]]:
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    return [(f.code, f.place.line) for f in found if f.code[:3] == 'CC3' and f.severity != 'note']


@pytest.mark.parametrize(('made', 'asked'), KINDS)
def test_two_callbacks_replace_the_object(made: str, asked: str) -> None:
    text = PROGRAM.replace('MADE', made).replace('ASKED', asked)
    assert warned(text.replace('AGAIN', f'self.held = {made}')) == [('CC301', 25)]


@pytest.mark.parametrize(('made', 'asked'), KINDS)
def test_what_only_the_set_up_makes_is_no_data(made: str, asked: str) -> None:
    kept = PROGRAM.replace('            self.held = MADE\n', '').replace('AGAIN', 'pass')
    (unit,) = scan_text(kept.replace('MADE', made).replace('ASKED', asked)).units
    names = {access.name for callback in unit.callbacks for access in callback.reads}
    assert 'Player.held' not in names
