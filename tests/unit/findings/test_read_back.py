"""CC301, CC304: what is written and read back after a wait, by code that two callbacks run."""

from __future__ import annotations

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

BUS = """
import threading, time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Bus:
    def __init__(self):
        self.lock = threading.Lock()
        self.line = b''

    def write(self, request):
        self.line = request
        {pause}

    def read(self):
        return self.line

    def ask(self, request):
        {ask}


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.bus = Bus()
        one, two = MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()
        self.create_timer(0.01, self.poll, callback_group=one)
        self.create_timer(0.02, self.diagnose, callback_group=two)

    def poll(self):
        print(self.bus.ask(b'enc'))

    def diagnose(self):
        print(self.bus.ask(b'volt'))


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Driver())
executor.spin()
"""
BOTH = 'self.write(request); return self.read()'
LOCKED = f'with self.lock: {BOTH.replace("; ", chr(10) + " " * 12)}'.replace(
    'lock: ', 'lock:\n            '
)
EACH = """with self.lock:
            self.write(request)
        with self.lock:
            return self.read()"""


@pytest.mark.parametrize(
    ('pause', 'ask', 'kinds'),
    [
        ('time.sleep(0.002)', BOTH, {Severity.WARNING}),
        ('time.sleep(0.002)', EACH, {Severity.WARNING}),
        ('time.sleep(0.002)', LOCKED, set()),
        ('pass', BOTH, set()),
    ],
)
def test_one_callback_gets_what_was_meant_for_the_other(
    pause: str, ask: str, kinds: set[Severity]
) -> None:
    units = scan_text(BUS.format(pause=pause, ask=ask)).units
    found = findings_of(units, [], [None] * len(units))
    assert {f.severity for f in found if f.code == 'CC301'} == kinds


GATE = """
import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.active = False
        ActionServer(
            self, Fibonacci, 'move', execute_callback=self.execute, goal_callback=self.on_goal,
            callback_group=ReentrantCallbackGroup())

    def reachable(self, request):
        return all(step % 7 >= 0 for step in range(request.order))

    def on_goal(self, request):
        if self.active:
            return GoalResponse.REJECT
        {between}
        self.active = True
        return GoalResponse.ACCEPT

    def execute(self, goal_handle):
        goal_handle.succeed()
        self.active = False
        return Fibonacci.Result()


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Arm())
executor.spin()
"""


@pytest.mark.parametrize(
    ('between', 'severity'),
    [('self.reachable(request)', Severity.WARNING), ('order = request.order', Severity.NOTE)],
)
def test_a_test_and_its_write_are_parted_by_a_function_of_the_program(
    between: str, severity: Severity
) -> None:
    units = scan_text(GATE.format(between=between)).units
    found = findings_of(units, [], [None] * len(units))
    assert [f.severity for f in found if f.code == 'CC304'] == [severity]
