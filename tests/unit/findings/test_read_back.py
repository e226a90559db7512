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


WAYS = """
import time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Streamer(Node):
    def __init__(self):
        super().__init__('streamer')
        self.state = None
        self.create_timer(0.1, self.tick, callback_group=ReentrantCallbackGroup())

    def now(self):
        return self.get_clock().now().nanoseconds

    def store(self):
        self.state = self.now()
        time.sleep(0.3)

    def show(self):
        self.get_logger().info(f'state {{self.state}}')

    def either(self, stores):
        if stores:
            self.store()
        else:
            self.show()

    def tick(self):
{body}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Streamer())
executor.spin()
"""
ONE_WAY = {
    'in a row': 'self.store(); self.show()',
    'behind a branch': """if self.now() % 2:
    self.store()
self.show()""",
    'in two branches': """odd = self.now() % 2
if odd:
    self.store()
if odd:
    self.show()""",
    'in two calls': 'self.either(True); self.either(False)',
    'in two calls by data': 'self.either(self.now() % 2); self.either(self.now() % 3)',
    'behind a loop that is left': """for number in range(self.now()):
    if number % 7:
        self.store()
        break
self.show()""",
    'in two rounds': """while self.now() % 2:
    if self.now() % 3:
        self.store()
    else:
        self.show()""",
    'in a handler': """try:
    self.state = self.now()
    int('x')
except ValueError:
    time.sleep(0.3)
self.show()""",
    'behind what returns': """try:
    if self.now() % 2:
        self.store()
        return
finally:
    self.show()""",
    'in a test': """if self.now() and self.store():
    pass
self.show()""",
}
NO_WAY = {
    'in two arms': """if self.now() % 2:
    self.store()
else:
    self.show()""",
    'in a function of two arms': 'self.either(self.now() % 2)',
    'behind a return': """if self.now() % 2:
    self.store()
    return
self.show()""",
    'the wait stands where nothing is stored': """if self.now() % 2:
    self.state = self.now()
    return
time.sleep(0.3)
self.show()""",
    'the wait alone returns': """self.state = self.now()
if self.state % 2:
    time.sleep(0.3)
    return
self.show()""",
    'the handler returns': """try:
    self.state = self.now()
except ValueError:
    time.sleep(0.3)
    return
self.show()""",
    'stored again': """if self.now() % 2:
    self.store()
    self.state = 1
self.show()""",
}


@pytest.mark.parametrize(
    ('body', 'is_said'),
    [
        *(pytest.param(body, True, id=name) for name, body in ONE_WAY.items()),
        *(pytest.param(body, False, id=name) for name, body in NO_WAY.items()),
    ],
)
def test_the_write_the_wait_and_the_read_lie_on_one_way(body: str, is_said: bool) -> None:
    text = WAYS.format(body='\n'.join(f'        {line}' for line in body.splitlines()))
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    assert ['and reads it here' in f.message for f in found if f.code == 'CC304'] == (
        [True] if is_said else []
    )


@pytest.mark.parametrize(
    ('read', 'severity'),
    [
        ('return self.line', Severity.WARNING),
        ('return len(self.line)', Severity.WARNING),
        ('if self.line: print(self.line)', Severity.WARNING),
        ('return 1 if self.line else 2', Severity.NOTE),
        ('if self.line: return 1', Severity.NOTE),
        ("if not self.line or self.line == b'enc': return 1", Severity.NOTE),
        ('assert self.line is not None', Severity.NOTE),
    ],
)
def test_what_only_a_test_looks_at_may_be_anybodys(read: str, severity: Severity) -> None:
    text = BUS.format(pause='time.sleep(0.002)', ask=BOTH).replace('return self.line', read)
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    said = [f for f in found if f.code == 'CC301' and 'reads it back' in f.message]
    assert {each.severity for each in said} == {severity}
