"""An item that was looked up in a collection, and changed after a wait: others find the same."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """
import threading
import time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

class Beds:
    def __init__(self):
        self.lock = threading.Lock()
        self.taken = [False] * 2

    def free(self):
        for bed, taken in enumerate(self.taken):
            if not taken:
                return bed
        return None

    def take(self, bed):
        self.taken[bed] = True

class Ward(Node):
    def __init__(self):
        super().__init__('ward')
        self.beds = Beds()
        self.calls = []
        self.stock = {'bolt': 4}
        group = ReentrantCallbackGroup()
        self.create_service(Trigger, 'go', self.on_go, callback_group=group)
        self.create_subscription(Empty, 'other', self.on_other, 10, callback_group=group)

    def on_go(self, request, response):
        GO
        return response

    def on_other(self, message):
        OTHER

rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Ward())
executor.spin()
"""
TAKE = 'bed = self.beds.free(); time.sleep(0.2); self.beds.take(bed)'
AT_ONCE = 'bed = self.beds.free(); self.beds.take(bed)'
WITHIN = """for bed, taken in enumerate(self.beds.taken):
            if not taken:
                time.sleep(0.2)
                self.beds.taken[bed] = True"""
LOCKED = """with self.beds.lock:
            bed = self.beds.free()
            time.sleep(0.2)
            self.beds.take(bed)"""
LOCKED_TWICE = """with self.beds.lock:
            bed = self.beds.free()
        time.sleep(0.2)
        with self.beds.lock:
            self.beds.take(bed)"""
ANSWER = 'call = self.calls[0]; time.sleep(0.2); self.calls.remove(call)'
COUNT = (
    'left = self.stock.get(request.name, 0); time.sleep(0.2); self.stock[request.name] = left - 1'
)


@pytest.mark.parametrize(
    ('go', 'other', 'told'),
    [
        (TAKE, 'pass', ['CC304 warning']),
        (TAKE, TAKE, ['CC301 warning']),
        (WITHIN, 'pass', ['CC304 warning']),
        (LOCKED, LOCKED, []),
        (LOCKED_TWICE, 'pass', ['CC304 warning']),
        (LOCKED_TWICE, LOCKED_TWICE, ['CC301 warning']),
        (ANSWER, ANSWER, ['CC301 warning']),
        # At once it is not reported, like other changes in place.
        (AT_ONCE, 'pass', []),
        (AT_ONCE, AT_ONCE, ['CC301 note']),
        # Somebody else's items are others.
        ('bed = request.bed; time.sleep(0.2); self.beds.take(bed)', 'pass', []),
        ('pass', 'if self.calls: time.sleep(0.2); self.calls.append(message)', []),
        # What is stored was computed from what stood there.
        (COUNT, 'pass', ['CC304 warning']),
        (COUNT, COUNT, ['CC301 warning']),
        (COUNT.replace('left - 1', 'request.number'), 'pass', []),
    ],
)
def test_what_two_looked_up_is_one_item(go: str, other: str, told: list[str]) -> None:
    text = NODE.replace('GO', go).replace('OTHER', other)
    findings = findings_of(scan_text(text).units, [], [None])
    races = [f for f in findings if f.code.startswith('CC3')]
    assert [f'{f.code} {f.severity.value}' for f in races] == told
