"""A class that is a node and a thread has the methods of both, whichever base comes first."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Camera(BASES):
    def __init__(self):
        Node.__init__(self, 'camera')
        threading.Thread.__init__(self)
        self.halted = threading.Event()
        self.create_subscription(Empty, 'halt', self.on_halt, 10)

    def on_halt(self, msg):
        SETS

    def run(self):
        while not self.halted.is_set():
            rclpy.spin_once(self, timeout_sec=0.1)

def main():
    rclpy.init()
    camera = Camera()
    camera.start()
    camera.join()

if __name__ == '__main__':
    main()
"""


@pytest.mark.parametrize('bases', ['Node, threading.Thread', 'threading.Thread, Node'])
def test_it_is_spun_by_its_own_thread(bases: str) -> None:
    found = scan_text(PROGRAM.replace('BASES', bases).replace('SETS', 'self.halted.set()'))
    assert [each.message for each in found.diagnostics] == []
    (unit,) = found.units
    assert [each.name for each in unit.callbacks] == ['on_halt']
    assert unit.executor.in_thread
    waits = [wait for each in unit.activities for wait in each.blocking]
    (joined,) = [wait for wait in waits if wait.call == 'Thread.join']
    assert [waker.by for waker in joined.wakers] == ['run']


@pytest.mark.parametrize('bases', ['Node, threading.Thread', 'threading.Thread, Node'])
def test_its_callbacks_are_judged(bases: str) -> None:
    found = scan_text(PROGRAM.replace('BASES', bases).replace('SETS', 'time.sleep(3)'))
    findings = findings_of(found.units, [], [None])
    assert 'CC201' in [each.code for each in findings]
