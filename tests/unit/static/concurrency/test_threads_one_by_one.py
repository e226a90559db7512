"""Threads of which a test lets only one run at a time, as distinct from those that may meet."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.camera = rclpy.create_node('camera')
        self.lock = threading.Lock()
        self.worker = None
        group = GROUP
        self.create_service(Trigger, 'pick', self.on_pick, callback_group=group)
        self.create_service(Trigger, 'place', self.on_place, callback_group=group)

    def on_pick(self, request, response):
        PICK
        return response

    def on_place(self, request, response):
        PLACE
        return response

    def look(self):
        BEGIN
        rclpy.spin_once(self.camera, timeout_sec=0.1)
        END

    def search(self):
        BEGIN
        while rclpy.ok():
            rclpy.spin_once(self.camera, timeout_sec=0.2)
        END

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Arm())
executor.spin()
"""
ALIVE = 'self.worker is not None and self.worker.is_alive()'
IF_ALIVE = f'if {ALIVE}: return response'
START = 'self.worker = threading.Thread(target=self.{}); self.worker.start()'
OTHER = 'self.worker = threading.Thread(target=print); threading.Thread(target=self.{}).start()'


def told(first: str, **more: str) -> bool:
    return 'executor-spun-twice' in slugs(first, **more)


def slugs(
    first: str, *, second: str = '', begin: str = 'pass', end: str = 'pass', group: str = 'None'
) -> set[str]:
    second = second or first
    text = PROGRAM
    for name, what in (
        ('GROUP', group),
        ('PICK', first.format('look')),
        ('PLACE', second.format('search')),
        ('BEGIN', begin),
        ('END', end),
    ):
        text = text.replace(name, what)
    return {each.slug for each in scan_text(text).diagnostics}


def lines(*statements: str) -> str:
    return '\n        '.join(statements)


@pytest.mark.parametrize(
    'guard',
    [
        IF_ALIVE,
        'if self.worker and self.worker.is_alive(): return response',
        'if request is None or (self.worker and self.worker.is_alive()): return response',
    ],
)
def test_one_that_begins_only_when_the_one_before_has_ended(guard: str) -> None:
    assert not told(lines(guard, START))
    assert not told(lines(guard, START), end='self.worker = None')


def test_it_begins_where_it_has_ended() -> None:
    guard = 'if self.worker is None or not self.worker.is_alive():'
    assert not told(lines(guard, '    ' + START))


def test_a_lock_makes_one_piece_of_test_and_start() -> None:
    free = 'ReentrantCallbackGroup()'
    locked = lines('with self.lock:', f'    {IF_ALIVE}', f'    {START}')
    assert not told(locked, group=free)
    late = lines(
        'with self.lock:',
        f'    {IF_ALIVE}',
        '    self.worker = threading.Thread(target=self.{})',
        'self.worker.start()',
    )
    assert told(late, group=free)


@pytest.mark.parametrize(
    ('first', 'second', 'end'),
    [
        (START, '', 'pass'),
        (lines(IF_ALIVE, START), START, 'pass'),
        (lines(IF_ALIVE, OTHER), '', 'pass'),
        (lines(f'if {ALIVE} and request: return response', START), '', 'pass'),
        (lines(IF_ALIVE, START), lines('self.worker = None', IF_ALIVE, START), 'pass'),
    ],
)
def test_those_that_may_meet(first: str, second: str, end: str) -> None:
    assert told(first, second=second, end=end)


def test_one_that_hides_itself_goes_on() -> None:
    assert told(lines(IF_ALIVE, START), begin='self.worker = None')


def test_nobody_else_spins_while_one_destroys() -> None:
    ends = 'self.camera.destroy_timer(self.camera.create_timer(1.0, print))'
    destroyed = 'destroyed-while-spun'
    assert destroyed in slugs(START, end=ends)
    assert destroyed not in slugs(lines(IF_ALIVE, START), end=ends)
