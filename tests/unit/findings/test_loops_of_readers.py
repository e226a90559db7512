"""CC109 and CC120: a thread whose loop ends nobody knows when gives what callbacks wait for."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path
from textwrap import indent

import pytest

from ros2cc_extract.cli.main import main

NODE = """\
import queue
import random
import threading
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Bridge(Node):
    def __init__(self):
        super().__init__('bridge')
        self.asked, self.replied = queue.Queue(), queue.Queue()
        self.replies = threading.Semaphore(0)
        self.event, self.lock = threading.Event(), threading.Lock()
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()
        self.create_service(Trigger, 'ask', self.on_ask)

    def line(self):
        line = self.asked.get()
        return line if line != 'end' else None

    def lines(self):
        while (line := self.line()) is not None:
            yield line

    def read(self):
{read}

    def on_ask(self, request, response):
{ask}
        return response


def main():
    rclpy.init()
    node = Bridge()
    rclpy.spin(node)
    node.asked.put('end')
    rclpy.shutdown()


main()
"""
PUT = 'self.replied.put(line)'
ASK = "self.asked.put('a')\nresponse.message = self.replied.get()"
ROUND = f"""\
while True:
    line = self.line()
    if line is None:
        break
    {PUT}"""

OPEN, HANGS = ('CC120', 'note'), ('CC109', 'error')
WAYS: dict[str, tuple[str, str, tuple[str, str]]] = {
    # What the thread does; what the callback does, which waits in its last line; what is told.
    'break': (ROUND, ASK, OPEN),
    'return': (ROUND.replace('break', 'return'), ASK, OPEN),
    'generator': (f'for line in self.lines():\n    {PUT}', ASK, OPEN),
    'iter': (f'for line in iter(self.line, None):\n    {PUT}', ASK, OPEN),
    'walrus': (f'while (line := self.line()) is not None:\n    {PUT}', ASK, OPEN),
    'first': (f'line = self.line()\nwhile line:\n    {PUT}\n    line = self.line()', ASK, OPEN),
    'chance': (f'while random.random() < 0.9:\n    line = self.line()\n    {PUT}', ASK, OPEN),
    'number': (
        f'for _ in range(random.randint(1, 9)):\n    line = self.line()\n    {PUT}',
        ASK,
        OPEN,
    ),
    'semaphore': (
        ROUND.replace(PUT, 'self.replies.release()'),
        "self.asked.put('a')\nself.replies.acquire()",
        OPEN,
    ),
    'cleared event': (
        ROUND.replace(PUT, 'self.event.set()'),
        "self.event.clear()\nself.asked.put('a')\nself.event.wait()",
        OPEN,
    ),
    # However many rounds there are.
    'once': (f'line = self.line()\n{PUT}', ASK, HANGS),
    'lock': (
        ROUND.replace(PUT, 'with self.lock:\n        self.replies.release()'),
        "with self.lock:\n    self.asked.put('a')\n    self.replies.acquire()",
        HANGS,
    ),
}


@pytest.mark.parametrize('way', WAYS)
def test_how_often_it_gives_is_not_known(way: str, tmp_path: Path) -> None:
    read, ask, told = WAYS[way]
    file = tmp_path / 'node.py'
    text = NODE.format(read=indent(read, ' ' * 8), ask=indent(ask, ' ' * 8))
    file.write_text(text)
    out = StringIO()
    main(['check', '--no-cache', '--output-format', 'json', str(file)], out, StringIO())
    found = json.loads(out.getvalue())['findings']
    line = text[: text.index('        return response')].count('\n')
    here = {(each['code'], each['severity']) for each in found if each['line'] == line}
    assert here == {told}
    assert not [each for each in found if each['severity'] == 'error' and each['line'] != line]
