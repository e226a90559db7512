"""Executors of one program that wait for each other; no unit alone shows the circle."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

NODES = """\
import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

{nodes}

def main():
    rclpy.init()
    {make}
    one, other = {executor}, {executor}
    one.add_node(left)
    other.add_node(right)
    thread = threading.Thread(target=one.spin, daemon=True)
    thread.start()
    other.spin()


main()
"""
SERVICES = """
class Left(Node):
    def __init__(self):
        super().__init__('left')
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'map', callback_group=group)
        self.create_timer(1.0, self.plan)
        self.create_service(Trigger, 'pose', self.pose, callback_group={group})

    def plan(self):
        self.client.call(Trigger.Request())  # waits here

    def pose(self, request, response):
        return response


class Right(Node):
    def __init__(self):
        super().__init__('right')
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'pose', callback_group=group)
        self.create_service(Trigger, 'map', self.map)

    def map(self, request, response):
        return self.client.call(Trigger.Request())

"""
EVENTS = """
class Left(Node):
    def __init__(self, here, there):
        super().__init__('left')
        self.here, self.there = here, there
        self.create_subscription(Empty, 'go', self.go, 10)
        self.create_subscription(Empty, 'token', self.token, 10)

    def go(self, msg):
        self.there.wait()  # waits here

    def token(self, msg):
        self.here.set()


class Right(Node):
    def __init__(self, here, there):
        super().__init__('right')
        self.here, self.there = here, there
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.here.wait({timeout})
        self.there.set()

"""
LOCKS = """
class Left(Node):
    def __init__(self):
        super().__init__('left')
        self.map_lock, self.pose_lock = threading.Lock(), threading.Lock()
        self.create_timer(0.1, self.tick)

    def tick(self):
        with self.map_lock:
            with self.pose_lock:  # waits here
                pass


class Right(Node):
    def __init__(self, left):
        super().__init__('right')
        self.left = left
        self.create_timer(0.1, self.tick)

    def tick(self):
        with self.left.{first}:
            with self.left.{second}:
                pass

"""
SINGLE, POOL = 'SingleThreadedExecutor()', 'MultiThreadedExecutor(num_threads=4)'
OWN, DEFAULT = 'MutuallyExclusiveCallbackGroup()', 'None'
PLAIN = 'left, right = Left(), Right()'
SHARED = 'here = threading.Event(); there = threading.Event(); left = Left(here, there); right = '
SHARED += 'Right(here, there)'
LOCKED = 'left = Left(); right = Right(left)'
MAP_FIRST = {'first': 'map_lock', 'second': 'pose_lock'}
POSE_FIRST = {'first': 'pose_lock', 'second': 'map_lock'}


@pytest.mark.parametrize(
    ('nodes', 'values', 'make', 'executor', 'code'),
    [
        (SERVICES, {'group': DEFAULT}, PLAIN, POOL, 'CC109'),
        (SERVICES, {'group': OWN}, PLAIN, POOL, None),
        (EVENTS, {'timeout': ''}, SHARED, SINGLE, 'CC109'),
        (EVENTS, {'timeout': '1.0'}, SHARED, SINGLE, None),
        (LOCKS, POSE_FIRST, LOCKED, SINGLE, 'CC111'),
        (LOCKS, MAP_FIRST, LOCKED, SINGLE, None),
    ],
)
def test_a_circle_of_two_executors_is_found(
    tmp_path: Path,
    nodes: str,
    values: dict[str, str],
    make: str,
    executor: str,
    code: str | None,
) -> None:
    path = tmp_path / 'two.py'
    path.write_text(NODES.format(nodes=nodes.format(**values), make=make, executor=executor))
    line = next(n for n, text in enumerate(path.read_text().splitlines(), 1) if 'waits he' in text)
    out = StringIO()

    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())

    found = [
        (each['code'], each['line'], each['severity'])
        for each in json.loads(out.getvalue())['findings']
        if each['code'] not in ('CC121', 'CC201', 'CC403')
    ]
    assert found == ([] if code is None else [(code, line, 'error')])
