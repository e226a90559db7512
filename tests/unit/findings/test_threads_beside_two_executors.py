"""A thread that touches no node belongs to the unit with which it shares locks or data."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """\
import threading
import time
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32


class Model:
    def __init__(self):
        self.lock = threading.Lock()
        self.values = {}
        self.total = 0
        self.panel = None

    def update(self, key):
        with self.lock:
            self.values[key] = 1
            self.panel.mark(key)

    def snapshot(self):
        with self.lock:
            return dict(self.values)


class Panel:
    def __init__(self, model):
        self.lock = threading.Lock()
        self.model = model
        self.dirty = set()

    def mark(self, key):
        with self.lock:
            self.dirty.add(key)

    def redraw(self):
        while True:
            time.sleep(0.1)
            {redraw}

    def draw(self):
        with self.lock:
            self.model.snapshot()


class Reader(Node):
    def __init__(self, model):
        super().__init__('reader')
        self.model = model
        self.create_subscription(Int32, 'value', self.heard, 10)

    def heard(self, msg):
        self.model.update('value')
        self.model.total += msg.data


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.create_timer(0.1, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    side = SingleThreadedExecutor()
    side.add_node(Robot())
    threading.Thread(target=side.spin, daemon=True).start()
    model = Model()
    model.panel = Panel(model)
    threading.Thread(target=model.panel.redraw, daemon=True).start()
    rclpy.spin(Reader(model))


main()
"""


@pytest.mark.parametrize(
    ('redraw', 'codes'),
    [
        ('self.draw()', {'CC111'}),
        ('self.model.snapshot()', set()),
        ('self.model.total += 1', {'CC301'}),
        ('pass', set()),
    ],
)
def test_what_a_thread_shares_with_one_of_two_units(redraw: str, codes: set[str]) -> None:
    scanned = scan_text(NODE.replace('{redraw}', redraw))
    assert {each.code for each in findings_of(scanned.units, scanned.diagnostics)} == codes
