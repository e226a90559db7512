"""CC110: what keeps a program at its end, though its own text would end it if it got there."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path
from textwrap import indent

import pytest

from ros2cc_extract.cli.main import main

NODE = """\
import asyncio
import atexit
import queue
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from http.server import BaseHTTPRequestHandler, HTTPServer
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Page(BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200)


class Port:
    def __init__(self):
        self.is_open = True
        self.lines = queue.Queue()
        threading.Thread(target=self.give, daemon=True).start()

    def give(self):
{give}

    def take(self, timeout=None):
        return self.lines.get(timeout=timeout)


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.port = Port()
        self.halt = threading.Event()
        self.lines = queue.Queue()
        self.running = True
        self.count = 0
        self.loop = asyncio.new_event_loop()
        self.server = HTTPServer(('', 8000), Page)
        self.pub = self.create_publisher(String, 'out', 10)
        self.create_subscription(String, 'line', self.heard, 10)
        {start}

    def heard(self, msg):
        self.lines.put(msg.data)

    def use(self, line):
        self.count += len(line)

    def work(self):
{work}


def main():
    rclpy.init()
    node = Base()
    {before}
    rclpy.spin(node)
{end}


main()
"""
THREAD = 'threading.Thread(target=self.work).start()'
DAEMON = 'threading.Thread(target=self.work, daemon=True).start()'
POOL = 'ThreadPoolExecutor(1).submit(self.work)'
GIVES = 'for each in range(20):\n    self.lines.put(str(each))\n    time.sleep(0.1)'
ALWAYS = 'while True:\n    self.lines.put("line")\n    time.sleep(0.1)'
ENDS = 'for each in range(20):\n    self.lines.put(str(each))\nself.lines.put(None)'
TAKES = 'while self.port.is_open:\n    self.use(self.port.take())'
SIGNED = (
    'while self.port.is_open:\n    line = self.port.take()\n'
    '    if line is None:\n        return\n    self.use(line)'
)
HEARS = 'while self.running:\n    self.use(self.lines.get())'
CLOSE, STOP = 'node.port.is_open = False', 'node.running = False'
ASKS = 'while not self.halt.is_set():\n    time.sleep(0.1)'
LEAVES = (
    'while True:\n    self.count += 1\n    time.sleep(0.1)\n    if self.halt.is_set():\n        {}'
)
WORKS = 'while not self.halt.is_set():\n    self.count += 1\n    time.sleep(0.1)'
SENDS = 'while not self.halt.is_set():\n    self.pub.publish(String())\n    time.sleep(0.1)'
HOOK = 'atexit.register(node.halt.set)'
FOREVER = 'self.loop.run_forever()'
SERVES = 'self.server.serve_forever()'
STOPS = 'node.loop.call_soon_threadsafe(node.loop.stop)'


def told(
    folder: Path,
    work: str,
    *,
    give: str = GIVES,
    start: str = THREAD,
    before: str = '',
    end: str = '',
) -> list[str]:
    text = NODE.format(
        give=indent(give, ' ' * 8),
        start=start,
        work=indent(work, ' ' * 8),
        before=before,
        end=indent(f'{end}\nrclpy.shutdown()', ' ' * 4),
    )
    path, out = folder / 'way.py', StringIO()
    path.write_text(text, encoding='utf-8')
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    found = json.loads(out.getvalue())['findings']
    return [each['message'] for each in found if each['code'] == 'CC110']


@pytest.mark.parametrize('start', [THREAD, POOL])
@pytest.mark.parametrize(
    ('work', 'end', 'why'),
    [
        (TAKES, CLOSE, 'gives no more by then'),
        (TAKES.replace('while self.port.is_open', 'while True'), '', 'gives no more by then'),
        (HEARS, STOP, 'nothing spins the node whose callback would end that any more'),
    ],
)
def test_a_reader_that_nobody_gives_anything_any_more(
    start: str, work: str, end: str, why: str, tmp_path: Path
) -> None:
    (message,) = told(tmp_path, work, start=start, end=end)
    assert message.startswith('the program ends only when')
    assert why in message


@pytest.mark.parametrize(
    ('work', 'end', 'start', 'give'),
    [
        (TAKES, f"{CLOSE}\nnode.port.lines.put('')", POOL, GIVES),
        (TAKES.replace('take()', 'take(timeout=1.0)'), CLOSE, POOL, GIVES),
        (TAKES, CLOSE, DAEMON, GIVES),
        (TAKES, CLOSE, POOL, ALWAYS),
        (SIGNED, CLOSE, POOL, ENDS),
        (HEARS, f"{STOP}\nnode.lines.put('')", POOL, GIVES),
    ],
)
def test_a_reader_that_gets_one_more(
    work: str, end: str, start: str, give: str, tmp_path: Path
) -> None:
    assert told(tmp_path, work, end=end, start=start, give=give) == []


@pytest.mark.parametrize('start', [THREAD, POOL])
@pytest.mark.parametrize(
    'work', [ASKS, WORKS, LEAVES.format('return'), LEAVES.format('break'), 'self.halt.wait()']
)
def test_functions_of_the_exit_come_behind_all_threads(
    work: str, start: str, tmp_path: Path
) -> None:
    (message,) = told(tmp_path, work, start=start, before=HOOK)
    assert 'only a function of `atexit` ends that' in message


@pytest.mark.parametrize(
    ('work', 'start', 'end'),
    [
        (WORKS, DAEMON, ''),
        (LEAVES.format('return'), THREAD, 'node.halt.set()'),
        (WORKS, POOL, 'node.halt.set()'),
        (SENDS, THREAD, ''),  # it raises when rclpy is shut down
    ],
)
def test_what_ends_before_them_is_right(work: str, start: str, end: str, tmp_path: Path) -> None:
    assert told(tmp_path, work, start=start, before=HOOK, end=end) == []


@pytest.mark.parametrize('work', [FOREVER, SERVES])
@pytest.mark.parametrize('start', [THREAD, POOL])
def test_a_loop_or_a_server_that_nobody_stops(work: str, start: str, tmp_path: Path) -> None:
    (message,) = told(tmp_path, work, start=start)
    assert message.endswith('that nothing ends: the program never exits')


@pytest.mark.parametrize(
    ('work', 'start', 'end'),
    [
        (FOREVER, DAEMON, ''),
        (FOREVER, THREAD, STOPS),
        (FOREVER, THREAD, 'loop = node.loop\nloop.call_soon_threadsafe(loop.stop)'),
        (SERVES, DAEMON, ''),
        (SERVES, THREAD, 'node.server.shutdown()'),
    ],
)
def test_one_that_is_stopped_ends(work: str, start: str, end: str, tmp_path: Path) -> None:
    assert told(tmp_path, work, start=start, end=end) == []
