"""CC201: a lock is held over a long sleep, and other callbacks wait for it."""

from __future__ import annotations

from pathlib import Path

import pytest
from finding_units import found, only

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.spec.model import Spec

NODE = """
import threading, time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty

class Lanes(Node):
    def __init__(self):
        super().__init__('lanes')
        self.lock = threading.Lock()
        self.lane = 0
        {start}
        self.create_subscription(Empty, 'stop', self.on_stop, 10)

    def drive(self):
        {drive}

    def on_stop(self, msg):
        {stop}

rclpy.init()
executor = MultiThreadedExecutor(num_threads={threads})
executor.add_node(Lanes())
executor.spin()
"""
TIMER = 'self.create_timer(9.0, self.drive, callback_group=MutuallyExclusiveCallbackGroup())'
THREAD = 'threading.Thread(target=self.drive, daemon=True).start()'
LOOP = 'while self.lane < time.time(): time.sleep(0.4)'
TAKES = 'with self.lock: self.lane'


def scanned(drive: str, folder: Path, **facts: object) -> Spec:
    given = {'start': TIMER, 'stop': TAKES, 'threads': 3, **facts}
    # A block on one line is one of its own.
    texts = {'drive': drive.replace(': while', ':\n            while')}
    path = folder / 'lanes.py'
    path.write_text(NODE.format(**{**given, **texts}), encoding='utf-8')
    (spec,) = scan([path], root=folder).units
    return spec


@pytest.mark.parametrize(
    ('drive', 'facts', 'expected'),
    [
        (f'with self.lock: {LOOP}', {}, ['CC201:19 warning']),
        (f'with self.lock: {LOOP}', {'start': THREAD}, ['CC201:19 warning']),
        ('with self.lock: time.sleep(1.5)', {}, ['CC201:18 warning']),
        ('with self.lock: time.sleep(0.4)', {}, []),
        ('with self.lock: self.lane += 1\n        time.sleep(1.5)', {}, []),
        ('while self.lane < time.time():\n            with self.lock: time.sleep(0.4)', {}, []),
        (f'with self.lock: {LOOP}', {'stop': 'self.lane'}, []),
        (f'with self.lock: {LOOP}', {'stop': 'self.lock.acquire(blocking=False)'}, []),
        (f'with self.lock: {LOOP}', {'threads': 1}, []),
        (f'with self.lock: {LOOP}', {'start': 'self.create_timer(9.0, self.drive)'}, []),
    ],
)
def test_who_sleeps_with_a_lock_keeps_others_waiting(
    drive: str, facts: dict[str, object], expected: list[str], tmp_path: Path
) -> None:
    told = found(scanned(drive, tmp_path, **facts))
    assert [code for code in told if code.startswith('CC2')] == expected


def test_messages(tmp_path: Path) -> None:
    endless = only(scanned(f'with self.lock: {LOOP}', tmp_path), 'CC201')
    assert endless.message == (
        'Lanes.drive sleeps 0.4 s in each round of a loop and holds lock meanwhile: '
        'Lanes.on_stop, which also takes it, waits until that is over'
    )
    assert [remark.text for remark in endless.related] == ['Lanes.on_stop takes lock here']
    known = only(scanned('with self.lock: time.sleep(1.5)', tmp_path), 'CC201')
    assert known.message == (
        'Lanes.drive sleeps 1.5 s and holds lock meanwhile: Lanes.on_stop, which also takes it, '
        'waits that long'
    )
