"""CC120: a future that only a thread makes done, awaited in a callback, wakes no executor."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

NODE = """
import threading
import rclpy
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger

class A(Node):
    def __init__(self):
        super().__init__('a')
        self.reply = Future()
        self.create_service(Trigger, 'go', self.on_go)
        MAKES_DONE

    def done(self, *_):
        self.reply.set_result('done')

    async def on_go(self, request, response):
        response.message = await self.reply
        return response

rclpy.init()
rclpy.spin(A())
"""


@pytest.mark.parametrize(
    ('makes_done', 'told'),
    [
        ('threading.Thread(target=self.done).start()', ['CC120']),
        ('self.create_client(Trigger, "x").call_async(None).add_done_callback(self.done)', []),
    ],
)
def test_who_awaits_what_a_thread_makes_done_is_told(
    tmp_path: Path, makes_done: str, told: list[str]
) -> None:
    path, out = tmp_path / 'a.py', StringIO()
    path.write_text(NODE.replace('MAKES_DONE', makes_done))
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    found = json.loads(out.getvalue())['findings']
    assert [each['code'] for each in found if each['code'] == 'CC120'] == told
