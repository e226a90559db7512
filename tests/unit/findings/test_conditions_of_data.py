"""A condition that is waited on and notified only as data says: no deadlock that nobody saw."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.generator.template_files import Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

PROGRAM = """\
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.changed = threading.Condition()
        self.writers = 0
        self.waiting = 0
        self.ready = False
        self.create_timer(0.1, self.read)
        self.create_timer(0.1, self.write)

    def read(self):
        with self.changed:
            READ

    def write(self):
        with self.changed:
            self.writers += 1
        with self.changed:
            self.writers -= 1
            WRITE

rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Arm())
executor.spin()
"""
WAIT = 'while {}:\n                self.changed.wait()'
WRITERS = 'self.waiting += 1\n            ' + WAIT.format('self.writers')
NOTIFY = 'self.changed.notify_all()'


@pytest.mark.parametrize(
    ('read', 'write', 'codes'),
    [
        (WRITERS, f'if self.waiting:\n                {NOTIFY}', ['CC120']),
        (WAIT.format('not self.ready'), f'self.ready = True\n            {NOTIFY}', ['CC101']),
    ],
    ids=['a lock for readers and writers', 'who sets it is kept out'],
)
def test_a_wait_by_data(read: str, write: str, codes: list[str]) -> None:
    text = PROGRAM.replace('READ', read).replace('WRITE', write)
    units = scan_text(text).units
    options = Options(profile=Profile.RCLPY, structural=False)
    found = findings_of(units, [], [verify_unit(close(unit), options) for unit in units])
    assert [each.code for each in found if each.code.startswith('CC1')] == codes
