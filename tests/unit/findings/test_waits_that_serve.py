"""A daemon thread that waits for what nobody has serves until the program ends."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

PROGRAM = """\
import asyncio
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Server(Node):
    def __init__(self):
        super().__init__('server')
        self.lock = threading.Lock()
        self.create_subscription(String, 'x', self.on_x, 10)
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def on_x(self, msg):
        {on_x}

    def run(self):
        asyncio.run(self.serve())

    async def serve(self):
        {wait}

rclpy.init()
rclpy.spin(Server())
"""
WAITS = ['await asyncio.Future()', 'await asyncio.Event().wait()']


def told(tmp_path: Path, wait: str, on_x: str = 'pass', thread: str = 'daemon=True') -> list[str]:
    path = tmp_path / 'server.py'
    text = PROGRAM.format(wait=wait, on_x=on_x)
    path.write_text(text.replace('daemon=True', thread))
    out = StringIO()
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    return [each['code'] for each in json.loads(out.getvalue())['findings']]


@pytest.mark.parametrize('wait', WAITS)
def test_it_is_meant_to_last(tmp_path: Path, wait: str) -> None:
    assert told(tmp_path, wait) == []


@pytest.mark.parametrize('wait', WAITS)
def test_who_waits_for_the_thread_waits_forever(tmp_path: Path, wait: str) -> None:
    assert told(tmp_path, wait, 'self.thread.join()') == ['CC109']


def test_a_lock_is_not_given_back(tmp_path: Path) -> None:
    wait = 'with self.lock:\n            await asyncio.Future()'
    assert 'CC109' in told(tmp_path, wait, 'self.lock.acquire()')


def test_what_has_a_name_may_have_been_forgotten(tmp_path: Path) -> None:
    wait = 'self.done = asyncio.Event()\n        await self.done.wait()'
    assert told(tmp_path, wait) == ['CC109']
