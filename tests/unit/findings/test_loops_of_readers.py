"""CC109 and CC120: a thread whose loop ends nobody knows when gives what callbacks wait for."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path
from textwrap import indent
from typing import Any

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
        self.running, self.halted = True, threading.Event()
        self.create_service(Trigger, 'ask', self.on_ask)
        self.create_service(Trigger, 'halt', self.on_halt)

{helpers}    def read(self):
{read}

    def on_ask(self, request, response):
{ask}
        return response

    def on_halt(self, request, response):
        {halt}
        return response


def main():
    rclpy.init()
    node = Bridge()
    rclpy.spin(node)
    node.asked.put('end')
    {end}
    rclpy.shutdown()


main()
"""
HELPERS = {
    'self.line': """\
    def line(self):
        line = self.asked.get()
        return line if line != 'end' else None

""",
    'self.served': """\
    def served(self):
        line = self.line()
        self.replied.put(line)
        return line != 'last'

""",
    'self.lines': """\
    def lines(self):
        while (line := self.line()) is not None:
            yield line

""",
}
PUT = 'self.replied.put(line)'
ASK = "self.asked.put('a')\nresponse.message = self.replied.get()"
ROUND = f"""\
while True:
    line = self.line()
    if line is None:
        break
    {PUT}"""

LAST = 'while True:\n    line = self.asked.get()\n    if not {}:\n        break\n    ' + PUT
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
    'called test': ('while self.served():\n    pass', ASK, OPEN),
    'line that may end it': (LAST.format('line'), 'self.asked.put(request)\n' + ASK, OPEN),
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
    'data': (
        'while random.random() < 0.9:\n    self.answer = self.line()',
        "self.answer = None\nself.asked.put('a')\nwhile self.answer is None: pass",
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


STOPS = {
    # A loop in which each round gives one thing, and what ends it.
    'flag': (f'while self.running:\n    line = self.line()\n    {PUT}', '{}.running = False'),
    'event': (
        f'while not self.halted.is_set():\n    line = self.line()\n    {PUT}',
        '{}.halted.set()',
    ),
}
OWN = 'done = threading.Event()\nself.asked.put(done)\ndone.wait()'
SENTINEL = (
    f'while True:\n    line = self.asked.get()\n    if line is None:\n        break\n    {PUT}'
)
LEFT = SENTINEL.replace('line is None', 'not self.running').replace('break', 'return')
STOPS |= {'inner flag': (LEFT, '{}.running = False'), 'item': (SENTINEL, '{}.asked.put(None)')}
STOPS['request'] = (STOPS['flag'][0].replace(PUT, 'line.set()'), STOPS['flag'][1])


def checked(
    folder: Path, read: str, ask: str, halt: str = 'pass', end: str = 'pass'
) -> tuple[list[dict[str, Any]], dict[str, str]]:
    """What is found in the line of the wait, and the marks of the promises."""
    file, out = folder / 'node.py', StringIO()
    read, ask = (indent(each, ' ' * 8) for each in (read, ask))
    used = ''
    for name, helper in reversed(HELPERS.items()):
        used = helper + used if f'{name}(' in read + used or f'{name},' in read else used
    text = NODE.format(helpers=used, read=read, ask=ask, halt=halt, end=end)
    file.write_text(text)
    main(['check', '--no-cache', '--output-format', 'json', str(file)], out, StringIO())
    report = json.loads(out.getvalue())
    (unit,) = report['promises']
    line = text[: text.index('        return response')].count('\n')
    assert not [f for f in report['findings'] if f['severity'] == 'error' and f['line'] != line]
    found = [each for each in report['findings'] if each['line'] == line]
    return found, {each['promise']: each['mark'] for each in unit['promises']}


@pytest.mark.parametrize('way', WAYS)
def test_how_often_it_gives_is_not_known(way: str, tmp_path: Path) -> None:
    read, ask, told = WAYS[way]
    found, marks = checked(tmp_path, read, ask)
    assert {(each['code'], each['severity']) for each in found} == {told}
    assert marks['every wait ends'] == ('broken' if told is HANGS else 'undecided')


@pytest.mark.parametrize('way', STOPS)
def test_who_asks_when_a_callback_has_ended_the_loop_may_wait_forever(
    way: str, tmp_path: Path
) -> None:
    read, stop = STOPS[way]
    ask = OWN if way == 'request' else ASK
    (found,), marks = checked(tmp_path, read, ask, halt=stop.format('self'))
    # Where the loop is left before its item is done, the model has the run.
    is_seen = way in ('item', 'inner flag')
    assert found['code'] == ('CC109' if is_seen else 'CC120')
    assert marks['every wait ends'] == ('broken' if is_seen else 'undecided')
    assert is_seen or found['message'].endswith(' once Bridge.on_halt has ended its loop')


@pytest.mark.parametrize('way', STOPS)
def test_who_asks_before_the_program_ends_the_loop_gets_an_answer(
    way: str, tmp_path: Path
) -> None:
    read, stop = STOPS[way]
    ask = OWN if way == 'request' else ASK
    found, marks = checked(tmp_path, read, ask, end=stop.format('node'))
    assert (found, marks['every wait ends']) == ([], 'kept')


@pytest.mark.parametrize('read', [SENTINEL, f'for line in iter(self.asked.get, None):\n    {PUT}'])
def test_an_item_that_nobody_puts_ends_no_loop(read: str, tmp_path: Path) -> None:
    found, marks = checked(tmp_path, read, ASK)
    assert (found, marks['every wait ends']) == ([], 'kept')


def test_who_joins_a_thread_that_no_item_ends_waits_forever(tmp_path: Path) -> None:
    ask = "self.asked.put('a')\nself.reader.join()"
    (found,), _ = checked(tmp_path, SENTINEL, ask)
    assert found['code'] == 'CC109'
    assert 'itself waits for asked (the item that ends the loop)' in found['message']
