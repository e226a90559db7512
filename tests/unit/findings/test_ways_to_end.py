"""CC109, CC110: ways in which a program does not end, and what ends it."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path
from textwrap import indent
from typing import Any

import pytest

from ros2cc_extract.cli.main import main

NODE = """\
import atexit
import concurrent.futures
import queue
import threading
import time
import rclpy
from rclpy.node import Node


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.jobs = queue.Queue()
        self.done = threading.Event()
        self.lock = threading.Lock()
        self.cond = threading.Condition()
        self.running = True
        self.create_timer(0.1, self.tick)
{init}

    def tick(self):
        pass

    def work(self):
{work}


def main():
    rclpy.init()
    node = Base()
    end = time.monotonic() + 1.0
    while time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.1)
{end}


main()
"""
THREAD = 'self.worker = threading.Thread(target=self.work)\nself.worker.start()'
POOL = 'self.pool = concurrent.futures.ThreadPoolExecutor()\nself.pool.submit(self.work)'
GOES_ON = 'while self.running:\n    time.sleep(0.1)'
WAITS = 'self.done.wait()'
GETS = 'while self.running:\n    print(self.jobs.get())'
STOP, SET, JOIN = 'node.running = False', 'node.done.set()', 'node.worker.join()'
DOWN, END_POOL = 'rclpy.shutdown()', 'node.pool.shutdown()'
LOOKS = """\
while True:
    with self.lock:
        if not self.running:
            return"""
NOTIFIED = """\
with self.cond:
    while self.running:
        self.cond.wait()"""
NOTIFY = """\
with node.cond:
    node.running = False
    node.cond.notify_all()"""

ENDLESS, NEVER = 'CC110', 'CC109'
WAYS: dict[str, tuple[str, str, list[str], list[str], set[str]]] = {
    # How the thread is started, what it does; how the program ends, how it should, what is told.
    'item': (THREAD, GETS, [STOP, JOIN], [STOP, 'node.jobs.put(None)', JOIN], {NEVER, ENDLESS}),
    'event': (THREAD, WAITS, [JOIN], [SET, JOIN], {NEVER, ENDLESS}),
    'event set behind': (THREAD, WAITS, [JOIN, SET], [SET, JOIN], {NEVER, ENDLESS}),
    'flag': (THREAD, GOES_ON, [JOIN], [STOP, JOIN], {NEVER}),
    'flag behind': (THREAD, GOES_ON, [JOIN, STOP], [STOP, JOIN], {NEVER}),
    'condition': (THREAD, NOTIFIED, [STOP, JOIN], [NOTIFY, JOIN], {NEVER, ENDLESS}),
    'pool': (
        POOL,
        WAITS,
        ['node.pool.shutdown()'],
        [SET, 'node.pool.shutdown()'],
        {NEVER, ENDLESS},
    ),
    'pool at exit': (POOL, WAITS, [DOWN], [SET, DOWN], {NEVER, ENDLESS}),
    'shutdown behind': (
        THREAD,
        'while rclpy.ok():\n    time.sleep(0.1)',
        [JOIN, DOWN],
        [DOWN, JOIN],
        {ENDLESS},
    ),
    'held lock': (
        THREAD,
        LOOKS,
        [f'with node.lock:\n    {STOP}\n    {JOIN}'],
        [f'with node.lock:\n    {STOP}', JOIN],
        {ENDLESS},
    ),
    'rate': (
        f'self.rate = self.create_rate(10)\n{THREAD}',
        'while self.running and rclpy.ok():\n    self.rate.sleep()',
        [STOP, JOIN, DOWN],
        [STOP, DOWN, JOIN],
        {ENDLESS},
    ),
    'hook': (
        THREAD,
        WAITS,
        ['node.context.on_shutdown(node.worker.join)', DOWN],
        ['node.context.on_shutdown(node.done.set)', DOWN, JOIN],
        {NEVER, ENDLESS},
    ),
    'exit': (
        THREAD,
        WAITS,
        ['atexit.register(node.worker.join)', DOWN],
        ['atexit.register(node.worker.join)', SET, DOWN],
        {NEVER, ENDLESS},
    ),
}


def asked(way: str, end: list[str], folder: Path) -> tuple[set[str], dict[str, Any]]:
    """The codes that are told, and what is said of the waits."""
    init, work, *_ = WAYS[way]
    text = NODE.format(
        init=indent(init, ' ' * 8),
        work=indent(work, ' ' * 8),
        end=indent('\n'.join(end), ' ' * 4),
    )
    path, out = folder / 'way.py', StringIO()
    path.write_text(text, encoding='utf-8')
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    report = json.loads(out.getvalue())
    (unit,) = report['promises']
    said = {each['promise']: each for each in unit['promises']}
    return {each['code'] for each in report['findings']}, said['every wait ends']


@pytest.mark.parametrize('way', WAYS)
def test_an_end_that_never_comes_is_told(way: str, tmp_path: Path) -> None:
    _, _, end, _, codes = WAYS[way]
    assert asked(way, end, tmp_path)[0] == codes


@pytest.mark.parametrize('way', WAYS)
def test_the_end_that_comes_is_known(way: str, tmp_path: Path) -> None:
    found, waits = asked(way, WAYS[way][3], tmp_path)
    assert found == set()
    assert waits['mark'] == 'kept'
