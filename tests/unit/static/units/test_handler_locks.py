"""A handler of a signal takes a lock that the thread which it interrupts may hold."""

from __future__ import annotations

import pytest

from ros2cc_extract.diagnostics import Diagnostic
from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import asyncio
import signal
import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.lock = threading.{lock}()
        self.count = 0
        {before}
        signal.signal(signal.SIGUSR1, self.on_signal)
        {makes}

    def tick(self):
        with self.lock:
            self.count += 1

    def on_signal(self, number, frame):
        {handles}

    def report(self):
        with self.lock:
            print(self.count)


rclpy.init()
node = Base()
{main}
"""
TIMER = 'self.create_timer(0.1, self.tick)'
THREAD = 'threading.Thread(target=self.tick, daemon=True).start()'
SPIN = 'rclpy.spin(node)'
POOL = 'executor = MultiThreadedExecutor()\nexecutor.add_node(node)\nexecutor.spin()'
ASIDE = 'threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n'
TAKES = 'with self.lock: self.count = 0'
PATIENT = 'if self.lock.acquire(timeout=1.0): self.lock.release()'


def told(
    lock: str = 'Lock',
    before: str = 'pass',
    makes: str = TIMER,
    handles: str = TAKES,
    main: str = SPIN,
) -> list[Diagnostic]:
    text = PROGRAM.format(lock=lock, before=before, makes=makes, handles=handles, main=main)
    return [each for each in scan_text(text).diagnostics if each.slug == 'lock-order']


@pytest.mark.parametrize(
    ('given', 'who'),
    [
        ({}, 'Base.tick'),
        ({'handles': 'self.report()'}, 'Base.tick'),
        (
            {
                'main': 'executor = rclpy.executors.SingleThreadedExecutor()\n'
                'executor.add_node(node)\nexecutor.spin()'
            },
            'Base.tick',
        ),
        ({'main': 'while rclpy.ok():\n    rclpy.spin_once(node)'}, 'Base.tick'),
        ({'makes': 'pass', 'main': 'node.report()\nrclpy.spin(node)'}, 'the main program'),
        ({'makes': 'pass', 'main': 'rclpy.spin(node)\nnode.report()'}, 'the main program'),
        (
            {'main': ASIDE + 'while rclpy.ok():\n    node.report()'},
            'the main program',
        ),
    ],
)
def test_what_the_main_thread_holds_is_never_given_back(given: dict[str, str], who: str) -> None:
    (one,) = told(**given)

    assert one.message == (
        f'Base.on_signal, which handles a signal, takes lock, which {who} may hold in the same '
        'thread: it waits for what it has interrupted, forever'
    )
    assert [each.text for each in one.related] == [
        'lock is taken here, in the main thread',
        'the handler is set here',
    ]


@pytest.mark.parametrize(
    'given',
    [
        {'lock': 'RLock'},
        {'lock': 'Condition'},
        {'main': POOL},
        {'main': ASIDE + 'signal.pause()'},
        {'makes': THREAD},
        {'handles': PATIENT},
        {'handles': 'if self.lock.acquire(blocking=False): self.lock.release()'},
        {'handles': 'self.count = 0'},
        {'before': 'self.report()', 'makes': 'pass'},
    ],
)
def test_what_others_hold_or_may_be_taken_again_is_no_deadlock(given: dict[str, str]) -> None:
    assert told(**given) == []


def test_a_loop_of_asyncio_runs_its_handlers_between_two_callbacks() -> None:
    main = (
        'loop = asyncio.new_event_loop()\n'
        'loop.add_signal_handler(signal.SIGTERM, node.report)\n'
        'rclpy.spin(node)'
    )

    assert told(handles='self.count = 0', main=main) == []


BRANCH = """if number == 10:
            self.report()
        {then}"""


@pytest.mark.parametrize(
    ('handles', 'also'),
    [
        ('self.report(); self.tick()', []),
        ('self.tick()\n        self.tick()\n        if number: self.report()', []),
        (BRANCH.format(then='self.tick()'), [21]),
        (BRANCH.format(then='self.report()'), []),
        (BRANCH.format(then='else: self.tick()'), [21]),
        (BRANCH.format(then='self.tick()\n        self.on_end()'), [21]),
        (BRANCH.format(then=f'else:\n            {TAKES}'), [28]),
    ],
)
def test_a_lock_is_told_once_of_each_handler(handles: str, also: list[int]) -> None:
    (one,) = told(handles=handles.replace('self.on_end()', TAKES))

    others = [each for each in one.related if each.text == 'or it takes lock here']
    assert [each.place.line for each in others] == also


def test_two_handlers_are_two_faults() -> None:
    found = told(makes=f'{TIMER}; signal.signal(signal.SIGUSR2, lambda *_: self.report())')

    assert len(found) == 2
