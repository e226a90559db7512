"""Flags that are put up right behind their test: one run alone gets past them."""

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
from std_srvs.srv import Trigger

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.homed = False
        self.other = 0
        self.lock = threading.Lock()
        free = ReentrantCallbackGroup()
        self.create_service(Trigger, 'home', self.home, callback_group=free)
        self.create_service(Trigger, 'again', self.on_again, callback_group=free)

    def home(self, request, response):
        {begin}
        self.target = self.plan()
        time.sleep(5.0)
        self.move(self.target)
        {end}
        return response

    def on_again(self, request, response):
        {again}
        return response

    def plan(self):
        return [1.0]

    def move(self, target):
        pass

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Arm())
executor.spin()
"""
CLAIM = 'if self.homed: return response\n        self.homed = True'
TARGET = (
    'warning',
    'writes Arm.target, waits, and reads it here: the other run may have written it meanwhile',
)
FLAG_ITSELF = (
    'note',
    'writes Arm.homed because of what it has read of it before, without one lock around both: '
    'that may no longer hold',
)


def _races(text: str) -> list[tuple[str, str]]:
    findings = findings_of(scan_text(text).units, [], [None])
    races = (f for f in findings if f.code == 'CC304')
    return [(f.severity.value, f.message.partition(', and ')[2]) for f in races]


def _is_told(begin: str, *, end: str = 'pass', again: str = 'pass') -> bool:
    return TARGET in _races(NODE.format(begin=begin, end=end, again=again))


@pytest.mark.parametrize(
    'begin',
    [
        CLAIM,
        'if self.homed or self.other is None: return response\n        self.homed = True',
        'if self.homed: return response\n        if self.other: return response\n'
        '        self.homed = True',
        'if self.homed:\n            self.other = 1\n            return response\n'
        '        self.homed = True',
    ],
)
def test_one_run_alone_gets_past_a_flag_that_is_put_up_at_once(begin: str) -> None:
    assert not _is_told(begin)


def test_the_flag_itself_rests_on_the_lock_of_the_interpreter() -> None:
    assert _races(NODE.format(begin=CLAIM, end='pass', again='pass')) == [FLAG_ITSELF]


@pytest.mark.parametrize(
    'begin',
    [
        'pass',
        'self.homed = True',
        'if self.homed: return response\n        time.sleep(0.1)\n        self.homed = True',
        'if self.homed: return response\n        self.plan()\n        self.homed = True',
        'if self.homed: return response\n        print(1)\n        self.homed = True',
        'if self.homed: return response\n        for _ in (1, 2): pass\n        self.homed = True',
        'if self.homed: return response\n        with self.lock: self.homed = True',
        'if self.homed or self.plan(): return response\n        self.homed = True',
        'if self.homed: return response\n        self.homed = bool(self.plan())',
        'if self.homed: pass\n        self.homed = True',
        'if self.other: return response\n        self.homed = True',
    ],
)
def test_several_get_past_where_others_may_run_before_it_is_up(begin: str) -> None:
    assert _is_told(begin)


def test_who_lowers_the_flag_lets_another_run_in() -> None:
    assert _is_told(CLAIM, again='self.homed = False')
    assert _is_told(
        'if self.homed: return response\n        self.homed = True\n        self.homed = False'
    )


def test_who_holds_the_flag_lowers_it_at_its_end() -> None:
    assert not _is_told(CLAIM, end='self.homed = False')


def test_each_helper_has_a_flag_of_its_own() -> None:
    node = """
import time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Job:
    def __init__(self):
        self.begun = False

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.jobs = {}
        for name in self.get_parameter('names').value:
            self.jobs[name] = Job()
        free = ReentrantCallbackGroup()
        self.create_subscription(String, 'go', self.on_go, 10, callback_group=free)

    def on_go(self, msg):
        job = self.jobs[msg.data]
        if job.begun: return
        job.begun = True
        self.target = msg.data
        time.sleep(5.0)
        print(self.target)

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Arm())
executor.spin()
"""
    assert TARGET in _races(node)
