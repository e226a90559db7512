"""Where a machine's CPUs decide how many threads there are, a hang by their number says so."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.unit import verify_unit
from tests.bugs.test_bugs import COMPACT

PROGRAM = """\
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import Trigger


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.moves = True
        for name in ('turn', 'drive'):
            group = MutuallyExclusiveCallbackGroup()
            self.create_service(Trigger, name, self.on_order, callback_group=group)
        self.create_subscription(Bool, 'moves', self.on_moves, 10)

    def on_order(self, request, response):
        while self.moves:
            time.sleep(0.1)
        return response

    def on_moves(self, msg):
        self.moves = False


rclpy.init()
executor = MultiThreadedExecutor({})
executor.add_node(Base())
executor.spin()
"""


@pytest.mark.parametrize(
    ('threads', 'reason'),
    [('2', '2 threads in all, and each waits'), ('', '2 threads on a machine with 2 CPUs')],
)
def test_a_pool_that_is_used_up(threads: str, reason: str) -> None:
    (unit,) = scan_text(PROGRAM.format(threads)).units
    found = findings_of([unit], (), [verify_unit(close(unit), COMPACT)])
    (hang,) = [finding for finding in found if finding.code == 'CC109']
    assert reason in hang.message
