"""CC109 and CC120: how the life of a thread and the wait of a callback interlock."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path
from textwrap import indent

import pytest

from ros2cc_extract.cli.main import main

NODE = """\
import queue
import threading
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.asked, self.replied = queue.Queue(), queue.Queue()
        self.cond, self.event = threading.Condition(), threading.Event()
        self.ready, self.started, self.count = False, False, 0
        self.create_service(Trigger, 'ask', self.on_ask)
{init}

{work}

    def on_ask(self, request, response):
{ask}
        return response


def main():
    rclpy.init()
    node = Base()
    rclpy.spin(node)
{end}
    rclpy.shutdown()


main()
"""
THREAD = 'threading.Thread(target=self.work, daemon=True).start()'
ONCE = """\
def work(self):
    with self.cond:
        self.ready = True
        self.cond.notify_all()"""
WAITS = 'with self.cond:\n    self.cond.wait_for(lambda: self.ready)'
SERVE = """\
def work(self):
    while True:
        self.replied.put(self.asked.get())"""
ASK = "self.asked.put('a')\nresponse.message = self.replied.get()"
FIRE = """\
def arm(self):
    timer = threading.Timer(0.1, self.fire)
    timer.daemon = True
    timer.start()

def fire(self):
    self.event.set()
    self.arm()"""
BEAT = 'self.event.clear()\nself.event.wait()'
BY_NAME = """\
self.boxes = {}
for name in ('arm', 'base'):
    self.boxes[name] = queue.Queue()
    threading.Thread(target=self.work, args=(name,), daemon=True).start()"""
PAIR = """\
def work(self):
    while True:
        line, done = self.asked.get()
        done.set()"""
ASK_PAIR = "done = threading.Event()\nself.asked.put(('a', done))\ndone.wait()"
BEGIN = "self.create_service(Trigger, 'begin', self.on_begin)"
BEGINS = f"""\
def on_begin(self, request, response):
    if not self.started:
        self.started = True
        {THREAD}
    return response

"""
LOAD = """\
def work(self):
    if self.count_publishers('map') == 0:
        raise RuntimeError('not ready')
    self.event.set()"""
LAST = """\
def work(self):
    try:
        if self.count_publishers('map') == 0:
            raise RuntimeError('not ready')
    finally:
        self.event.set()"""
SETS = SERVE.replace(
    'self.replied.put(self.asked.get())', 'self.asked.get()\n        self.event.set()'
)
NOTIFIES = SETS.replace('self.event.set()', 'with self.cond:\n            self.cond.notify()')
ASK_EVENT = "self.event.clear()\nself.asked.put('a')\nself.event.wait()"
ASK_EARLY = "self.asked.put('a')\nself.event.clear()\nself.event.wait()"
ASK_BARE = "self.asked.put('a')\nwith self.cond:\n    self.cond.wait()"
ASK_HELD = "with self.cond:\n    self.asked.put('a')\n    self.cond.wait()"
KEPT, OPEN, BROKEN = 'kept', 'undecided', 'broken'

WAYS: dict[str, tuple[str, str, str, str, str]] = {
    # The constructor, the methods, the callback, the end of the program; the promise.
    'ready for good': (THREAD, ONCE, WAITS, '', KEPT),
    'taken back': (THREAD, ONCE, f'{WAITS}\n    self.ready = False', '', OPEN),
    'notified without the lock': (
        THREAD,
        'def work(self):\n    self.ready = True\n    self.cond.notify_all()',
        WAITS,
        '',
        OPEN,
    ),
    'counted': (
        THREAD,
        ONCE.replace('ready = True', 'count += 1'),
        WAITS.replace('self.ready', 'self.count >= 1'),
        '',
        OPEN,
    ),
    'asked by a method': (
        THREAD,
        f'{ONCE}\n\ndef is_ready(self):\n    return self.ready',
        WAITS.replace('lambda: self.ready', 'self.is_ready'),
        '',
        OPEN,
    ),
    'cleared in time': (THREAD, SETS, ASK_EVENT, '', KEPT),
    'cleared too late': (THREAD, SETS, ASK_EARLY, '', OPEN),
    'waits too late': (THREAD, NOTIFIES, ASK_BARE, '', OPEN),
    'asks in the hold': (THREAD, NOTIFIES, ASK_HELD, '', KEPT),
    'fails': (THREAD, LOAD, 'self.event.wait()', '', OPEN),
    'fails and tells': (THREAD, LAST, 'self.event.wait()', '', KEPT),
    'tells and fails': (
        THREAD,
        LOAD.replace('def work(self):', 'def work(self):\n    self.event.set()').removesuffix(
            '\n    self.event.set()'
        ),
        'self.event.wait()',
        '',
        KEPT,
    ),
    'armed again': ('self.arm()', FIRE, BEAT, '', KEPT),
    'armed some times': (
        'self.arm()',
        FIRE.replace(
            '    self.arm()', '    self.count += 1\n    if self.count < 5:\n        self.arm()'
        ),
        BEAT,
        '',
        OPEN,
    ),
    'by names': (
        BY_NAME,
        'def work(self, name):\n    while True:\n        self.boxes[name].put(1)',
        "self.boxes['base'].get()",
        '',
        KEPT,
    ),
    'by other names': (
        BY_NAME.replace('threading', "if name == 'arm': threading"),
        'def work(self, name):\n    while True:\n        self.boxes[name].put(1)',
        "self.boxes['base'].get()",
        '',
        BROKEN,
    ),
    'parts of an item': (THREAD, PAIR, ASK_PAIR, 'node.asked.put(None)', KEPT),
    'started perhaps': (f"if self.count_publishers('map'):\n    {THREAD}", SERVE, ASK, '', OPEN),
    'started before': (
        BEGIN,
        BEGINS + SERVE,
        f'if not self.started:\n    return response\n{ASK}',
        '',
        OPEN,
    ),
    'started or not': (BEGIN, BEGINS + SERVE, ASK, '', BROKEN),
}


@pytest.mark.parametrize('way', WAYS)
def test_every_wait_ends_if_the_thread_lives(way: str, tmp_path: Path) -> None:
    init, work, ask, end, mark = WAYS[way]
    file, out = tmp_path / 'node.py', StringIO()
    text = NODE.format(
        init=indent(init, ' ' * 8),
        work=indent(work, ' ' * 4),
        ask=indent(ask, ' ' * 8),
        end=indent(end, ' ' * 4),
    )
    file.write_text(text)
    main(['check', '--no-cache', '--output-format', 'json', str(file)], out, StringIO())
    report = json.loads(out.getvalue())
    (unit,) = report['promises']
    marks = {each['promise']: each['mark'] for each in unit['promises']}
    errors = [each['code'] for each in report['findings'] if each['severity'] == 'error']
    assert (marks['every wait ends'], bool(errors)) == (mark, mark == BROKEN)
