"""CC109: a coroutine is handed over to a loop of asyncio that no thread runs."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

PROGRAM = """
import asyncio
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        self.loop = asyncio.new_event_loop()
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.create_subscription(String, 'a', self.on_a, 10)

    async def switch(self):
        await asyncio.sleep(0.1)

    def serve(self):
        asyncio.set_event_loop(self.loop)
        self.loop.run_forever()

    def on_a(self, msg):
        {waits}


rclpy.init()
lamp = Lamp()
{runs}
"""
WAITS = [
    'asyncio.run_coroutine_threadsafe(self.switch(), self.loop).result()',
    'f = asyncio.run_coroutine_threadsafe(self.switch(), loop=self.loop); f.exception()',
]
SPINS = 'rclpy.spin(lamp)'
RUNS = [
    'lamp.thread.start(); rclpy.spin(lamp)',
    'threading.Thread(target=rclpy.spin, args=(lamp,)).start(); lamp.loop.run_forever()',
    'threading.Thread(target=rclpy.spin, args=(lamp,)).start(); '
    'lamp.loop.run_until_complete(asyncio.sleep(9999))',
    'threading.Thread(target=lamp.loop.run_forever, daemon=True).start(); rclpy.spin(lamp)',
]


def told(folder: Path, waits: str, runs: str) -> list[tuple[str, int]]:
    node, out = folder / 'lamp.py', StringIO()
    node.write_text(PROGRAM.format(waits=waits, runs=runs))
    main(['check', '--no-cache', '--output-format', 'json', str(node)], out, StringIO())
    found = json.loads(out.getvalue())['findings']
    return [(each['code'], each['line']) for each in found]


@pytest.mark.parametrize('waits', WAITS)
def test_what_waits_for_its_result_waits_forever(tmp_path: Path, waits: str) -> None:
    assert told(tmp_path, waits, SPINS) == [('CC109', 24)]


@pytest.mark.parametrize('runs', RUNS)
@pytest.mark.parametrize('waits', WAITS)
def test_where_some_thread_runs_it_nothing_is_told(tmp_path: Path, waits: str, runs: str) -> None:
    assert told(tmp_path, waits, runs) == []


def test_with_a_time_out_it_ends(tmp_path: Path) -> None:
    assert told(tmp_path, WAITS[0].replace('result()', 'result(0.1)'), SPINS) == []
