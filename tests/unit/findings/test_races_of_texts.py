"""*No data race* is open where a text that is not known decides what runs beside others."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.findings.races.handed_functions import races_with_others

PROGRAM = """\
import queue
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String

class Runner(Node):
    def __init__(self):
        super().__init__('runner')
        group = ReentrantCallbackGroup()
        self.items = {{}}
        self.queue = queue.Queue()
        self.create_subscription(String, 'cmd', self.on_cmd, 10, callback_group=group)
        self.create_timer(0.1, self.on_timer)
        {start}

    def on_cmd(self, msg):
        {on_cmd}

    def work(self):
        while True:
            {run}

    def add(self, key='a'):
        self.items[key] = len(self.items)

    def on_timer(self):
        for key in {over}:
            print(key)

rclpy.init()
{spin}
"""
THREAD = 'threading.Thread(target=self.work, daemon=True).start()'
PUT = 'self.queue.put(msg.data)'
ONE = 'rclpy.spin(Runner())'
POOL = 'executor = MultiThreadedExecutor(2)\nexecutor.add_node(Runner())\nexecutor.spin()'
TEXTS = ['exec(self.queue.get())', 'eval(self.queue.get())', 'getattr(self, self.queue.get())()']


def open_races(folder: Path, **parts: str) -> list[str]:
    given = {'start': THREAD, 'on_cmd': PUT, 'run': 'pass', 'spin': ONE, 'over': 'self.items'}
    path = folder / 'runner.py'
    path.write_text(PROGRAM.format(**{**given, **parts}), encoding='utf-8')
    (unit,) = scan([path], root=folder).units
    return list(races_with_others(unit))


@pytest.mark.parametrize('run', TEXTS)
def test_a_thread_may_call_any_method(run: str, tmp_path: Path) -> None:
    (why,) = open_races(tmp_path, run=run)
    assert 'Runner.add may run' in why
    assert 'by a text' in why


@pytest.mark.parametrize('run', TEXTS)
def test_what_it_may_call_disturbs_nobody(run: str, tmp_path: Path) -> None:
    assert open_races(tmp_path, run=run, over='()') == []


@pytest.mark.parametrize('run', TEXTS)
def test_a_callback_has_its_thread_to_itself(run: str, tmp_path: Path) -> None:
    own = run.replace('self.queue.get()', 'msg.data')
    assert open_races(tmp_path, on_cmd=own, start='pass') == []
    assert len(open_races(tmp_path, on_cmd=own, start='pass', spin=POOL)) == 1


def test_a_known_text_is_followed(tmp_path: Path) -> None:
    assert open_races(tmp_path, on_cmd='getattr(self, "add")()', start='pass', spin=POOL) == []
