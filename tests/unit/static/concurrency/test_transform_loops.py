"""Loops that only a new transform ends, which the listener's subscriptions must take."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.api import scan

NODE = """\
import threading
import time

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from std_srvs.srv import Trigger
from tf2_ros import Buffer, TransformException, TransformListener


class Follower(Node):
    def __init__(self):
        super().__init__('follower')
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self{given})
        self.pose = None
        self.create_service(Trigger, 'follow', self.on_follow)
{set_up}

    def is_there(self):
        return self.buffer.can_transform('map', 'base', Time())

    def on_follow(self, request, response):
{follow}
        return response


def main():
    rclpy.init()
    rclpy.spin(Follower())


main()
"""
LOOPS = [
    ["while not self.buffer.can_transform('map', 'base', Time()):", '    time.sleep(0.2)'],
    [
        'while not self.buffer.can_transform(',
        "    'map', 'base', Time(), timeout=Duration(seconds=1.0)",
        '):',
        "    self.get_logger().info('not there')",
    ],
    [
        "while not self.buffer.can_transform('map', 'base', self.get_clock().now()):",
        '    time.sleep(0.2)',
    ],
    ['while rclpy.ok() and not self.is_there():', '    pass'],
    ['while True:', '    if self.is_there():', '        break', '    time.sleep(0.1)'],
    [
        'while rclpy.ok():',
        '    try:',
        "        self.pose = self.buffer.lookup_transform('map', 'base', Time())",
        '        break',
        '    except TransformException as error:',
        "        self.get_logger().info(f'{error}')",
        '        time.sleep(0.2)',
    ],
    [
        'found = None',
        'while found is None:',
        '    try:',
        "        found = self.buffer.lookup_transform('map', 'base', Time(), Duration(seconds=1))",
        '    except TransformException:',
        '        time.sleep(0.2)',
    ],
]


def _scanned(tmp_path: Path, given: str, set_up: list[str], follow: list[str]) -> Extraction:
    path = tmp_path / 'follower.py'
    shown = ['\n'.join(8 * ' ' + line for line in lines) for lines in (set_up, follow)]
    path.write_text(NODE.format(given=given, set_up=shown[0], follow=shown[1]))
    return scan([path])


@pytest.mark.parametrize('loop', LOOPS)
def test_before_the_spin_no_transform_comes(tmp_path: Path, loop: list[str]) -> None:
    found = _scanned(tmp_path, '', loop, ['pass'])

    (told,) = [each for each in found.diagnostics if each.slug == 'nobody-spins']
    assert told.message == (
        'a polling loop waits for what comes on /tf while nothing spins the node that must take '
        'it: it waits forever'
    )


@pytest.mark.parametrize('loop', LOOPS)
def test_in_a_callback_the_loop_waits_for_the_listener(tmp_path: Path, loop: list[str]) -> None:
    (unit,) = _scanned(tmp_path, '', ['pass'], loop).units

    (follow,) = [each for each in unit.callbacks if each.name == 'on_follow']
    (wait,) = [each for each in follow.blocking if each.call == 'polling loop']
    assert wait.seconds is None and wait.escapes is None
    listeners = {each.name for each in unit.callbacks if each.key == '/tf'}
    assert {waker.by for waker in wait.wakers} == listeners | {'outside'}


@pytest.mark.parametrize('loop', LOOPS)
def test_a_thread_that_spins_brings_it(tmp_path: Path, loop: list[str]) -> None:
    aside = 'threading.Thread(target=rclpy.spin, args=(self,), daemon=True).start()'

    by_listener = _scanned(tmp_path, ', spin_thread=True', loop, ['pass'])
    by_program = _scanned(tmp_path, '', [aside, *loop], ['pass'])

    for found in (by_listener, by_program):
        assert [each for each in found.diagnostics if each.slug == 'nobody-spins'] == []


@pytest.mark.parametrize(
    'loop',
    [
        [
            'end = self.get_clock().now() + Duration(seconds=5)',
            'while not self.is_there() and self.get_clock().now() < end:',
            '    time.sleep(0.1)',
        ],
        ['for _ in range(5):', '    if self.is_there():', '        break'],
        ['while not self.is_there():', '    rclpy.spin_once(self)'],
        ['begun = time.time()', 'while not self.is_there() and time.time() < begun + 5: pass'],
        [
            'tries = 0',
            'while not self.is_there() and tries < 5:',
            '    tries += 1',
            '    time.sleep(0.1)',
        ],
    ],
)
def test_what_else_ends_it_is_minded(tmp_path: Path, loop: list[str]) -> None:
    found = _scanned(tmp_path, '', loop, ['pass'])

    assert [each for each in found.diagnostics if each.slug == 'nobody-spins'] == []
