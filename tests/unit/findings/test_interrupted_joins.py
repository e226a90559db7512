"""A join of the main program that catches Ctrl-C waits for that, as a spin does."""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.node import Node

class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.stop = threading.Event()
        self.lock = threading.Lock()
        self.create_timer(0.1, self.tick)

    def tick(self):
        print('tick')

    def work(self):
        WORK

rclpy.init()
node = Base()
threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
worker = threading.Thread(target=node.work)
worker.start()
try:
    worker.join()
except CAUGHT:
    print('ends')
node.stop.set()
"""
ROUNDS = [
    'while not self.stop.is_set():\n            time.sleep(0.1)',
    'while rclpy.ok() and not self.stop.is_set():\n            time.sleep(0.1)',
    'while not self.stop.wait(0.1):\n            print("works")',
]


def codes(folder: Path, work: str, caught: str) -> set[str]:
    (folder / 'node.py').write_text(PROGRAM.replace('WORK', work).replace('CAUGHT', caught))
    out = StringIO()
    main(
        ['check', '--no-cache', '--output-format', 'json', str(folder / 'node.py')],
        out,
        StringIO(),
    )
    found = json.loads(out.getvalue())['findings']
    return {each['code'] for each in found if each['severity'] != 'note'}


@pytest.mark.parametrize('work', ROUNDS)
def test_what_main_does_behind_it_comes(tmp_path: Path, work: str) -> None:
    assert codes(tmp_path, work, 'KeyboardInterrupt') == set()
    assert codes(tmp_path, work, '(RuntimeError, KeyboardInterrupt)') == set()
    assert codes(tmp_path, work, 'BaseException') == set()
    assert codes(tmp_path, work, 'RuntimeError') == {'CC109'}


def test_a_wait_of_the_thread_that_nothing_ends_is_told_nevertheless(tmp_path: Path) -> None:
    work = 'with self.lock:\n            self.lock.acquire()'
    assert codes(tmp_path, work, 'KeyboardInterrupt') == {'CC111'}
