"""Waits of code that no callback runs: they are in the specification, decided or reported."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Spec

NODE = """\
import subprocess
import threading

import rclpy
from plant import doors
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'home')
        self.drive = ActionClient(self, Trigger, 'drive')
        self.ready = threading.Event()
        self.pose = None
        self.create_subscription(Empty, 'pose', self.on_pose, 10)
        {first}

    def on_pose(self, msg):
        self.pose = msg
        self.ready.set()


def serve(node):
    node.ready.wait()


seen = []


def main():
    rclpy.init()
    node = Asker()
    {then}
    rclpy.spin(node)
    {last}


main()
"""


def unit_of(tmp_path: Path, **steps: str) -> Spec:
    text = NODE.format(**{'first': 'pass', 'then': 'pass', 'last': 'pass', **steps})
    (tmp_path / 'node.py').write_text(text)
    (unit,) = scan([tmp_path / 'node.py']).units
    return unit


def told(unit: Spec) -> list[str]:
    return [found.message for found in findings_of([unit], ()) if found.code == 'CC120']


def words(block: Blocking) -> str:
    enders = ', '.join(waker.by for waker in block.wakers)
    limit = f' {block.seconds} s' if block.seconds is not None else ''
    return f'{block.call}{limit}: {enders}'


@pytest.mark.parametrize(
    ('steps', 'waits'),
    [
        ({'first': 'self.client.wait_for_service(1.0)'}, ['wait_for_service 1.0 s: outside']),
        ({'first': 'self.drive.wait_for_server()'}, ['wait_for_server: outside']),
        ({'then': 'input()'}, ['input: outside']),
        ({'then': 'free = threading.Semaphore(2)\n    free.acquire()'}, ['Semaphore.acquire: ']),
        ({'then': "subprocess.run(['gcc'])"}, ['subprocess.run: outside']),
        (
            {
                'then': 'future = node.client.call_async(Trigger.Request())\n'
                '    rclpy.spin_until_future_complete(node, future)'
            },
            ['spin_until_future_complete: home_client'],
        ),
        (
            {
                'then': 'thread = threading.Thread(target=serve, args=(node,))\n'
                '    thread.start()',
                'last': 'thread.join()',
            },
            ['Thread.join: serve'],
        ),
        (
            {'then': 'while node.pose is None:\n        rclpy.spin_once(node)'},
            ['polling loop: on_pose'],
        ),
        (
            {
                'then': 'rclpy.spin_once(node)\n    if node.pose is None:\n        return\n'
                '    input()'
            },
            ['input: outside'],
        ),
        (
            {'then': 'rclpy.spin_once(node)\n    if not seen:\n        return\n    input()'},
            ['input: outside'],
        ),
        (
            {
                'then': 'future = node.client.call_async(Trigger.Request())\n'
                '    while not future.done():\n        rclpy.spin_once(node)'
            },
            ['busy wait: home_client'],
        ),
    ],
)
def test_waits_of_the_set_up_are_told_with_who_ends_them(
    tmp_path: Path, steps: dict[str, str], waits: list[str]
) -> None:
    unit = unit_of(tmp_path, **steps)
    assert ([words(block) for block in unit.set_up], told(unit)) == (waits, [])


@pytest.mark.parametrize(
    ('steps', 'message'),
    [
        (
            {'then': 'doors.open().wait()'},
            'not decided: main waits in doors.open().wait, and it is not known what ends it: '
            'result of plant.doors.open, which is not scanned',
        ),
    ],
)
def test_what_nobody_is_known_to_end_is_told(
    tmp_path: Path, steps: dict[str, str], message: str
) -> None:
    assert told(unit_of(tmp_path, **steps)) == [message]
