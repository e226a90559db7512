"""Services that hold all threads with the requests of known clients, on whatever executor."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

NODE = """\
import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'lock', callback_group=group)
        self.create_service(Trigger, 'open', self.open, callback_group=group)

    def open(self, request, response):
        return self.client.call(Trigger.Request())


class User(Node):
    def __init__(self, name):
        super().__init__(name)
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'open', callback_group=group)
        self.create_timer(0.1, self.ask)

    def ask(self):
        self.client.{ask}(Trigger.Request())


def main():
    rclpy.init()
    pool = MultiThreadedExecutor(num_threads={threads})
    pool.add_node(Gate())
    users = {users}
    for name in {names}:
        users.add_node(User(name))
    threading.Thread(target=users.spin, daemon=True).start()
    pool.spin()


main()
"""
SINGLE, POOL = 'SingleThreadedExecutor()', 'MultiThreadedExecutor(num_threads=4)'
MANY = '3 runs can wait at the same time (Gate.open 3 times) on 2 threads'
ITSELF = 'Gate.open may overlap itself in a wait'
SEND, WAIT = 'call_async', 'call'
THREE = ('a', 'b', 'c')


@pytest.mark.parametrize(
    ('ask', 'users', 'names', 'threads', 'level', 'message'),
    [
        (SEND, SINGLE, THREE, 2, 'error', MANY),
        (WAIT, POOL, THREE, 2, 'error', MANY),
        (SEND, SINGLE, THREE, 4, 'note', ITSELF),
        (SEND, SINGLE, ('a',), 2, 'note', ITSELF),
        (WAIT, 'MultiThreadedExecutor(num_threads=1)', THREE, 2, 'note', ITSELF),
    ],
)
def test_clients_in_sight_are_counted(
    tmp_path: Path,
    ask: str,
    users: str,
    names: tuple[str, ...],
    threads: int,
    level: str,
    message: str,
) -> None:
    path = tmp_path / 'gate.py'
    path.write_text(NODE.format(ask=ask, users=users, names=names, threads=threads))
    out = StringIO()

    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())

    found = [f for f in json.loads(out.getvalue())['findings'] if f['code'] == 'CC103']
    assert [each['severity'] for each in found] == [level]
    assert found[0]['message'].startswith(message)
