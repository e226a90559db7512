"""What decides the exit status: findings, and input that cannot be read at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.e2e.conftest import Run

CALLS_BEFORE_SPIN = """\
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


def main():
    rclpy.init()
    node = Node('starter')
    client = node.create_client(Trigger, 'start')
    client.call(Trigger.Request())
"""
KEEPS_A_LOCK = """\
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty


class Switch(Node):
    def __init__(self):
        super().__init__('switch')
        self.lock = threading.Lock()
        self.is_on = False
        self.create_subscription(Empty, 'switch', self.on_switch, 10)
        self.create_timer(1.0, self.tick)

    def on_switch(self, msg):
        self.lock.acquire()
        if self.is_on:
            return
        self.is_on = True
        self.lock.release()

    def tick(self):
        with self.lock:
            self.is_on = False


def main():
    rclpy.init()
    rclpy.spin(Switch())
"""
CLEAN = """\
import rclpy
from rclpy.node import Node


def main():
    rclpy.init()
    node = Node('clock')
    node.create_timer(1.0, print)
    rclpy.spin(node)
"""
BROKEN = 'import rclpy\ndef f(:\n'
NODES = {
    'CC110': (CALLS_BEFORE_SPIN, '    client.call(Trigger.Request())'),
    'CC112': (KEEPS_A_LOCK, '            return'),
}


@pytest.mark.parametrize('code', NODES)
def test_what_the_extractor_itself_notices_is_a_finding(
    run: Run, tmp_path: Path, code: str
) -> None:
    (tmp_path / 'node.py').write_text(NODES[code][0])
    outcome = run('check', 'node.py')
    assert (outcome.status, code in outcome.out) == (1, True)
    assert run('spec', 'node.py').status == 0


@pytest.mark.parametrize('code', NODES)
def test_it_can_be_accepted_by_comment_baseline_and_settings(
    run: Run, tmp_path: Path, code: str
) -> None:
    source, line = NODES[code]
    (tmp_path / 'node.py').write_text(source)
    (tmp_path / 'accepted.py').write_text(
        source.replace(line, f'{line}  # ros2cc: ignore[{code}] known')
    )
    assert run('check', 'accepted.py').status == 0
    assert run('check', 'node.py', '--write-baseline', 'known.json').status == 0
    assert run('check', 'node.py', '--baseline', 'known.json').status == 0
    (tmp_path / 'pyproject.toml').write_text(f'[tool.ros2cc]\nignore = ["{code}"]\n')
    assert run('check', 'node.py').status == 0


@pytest.mark.parametrize(('others', 'status'), [(CLEAN, 0), (CALLS_BEFORE_SPIN, 1)])
def test_beside_a_broken_file_the_others_decide(
    run: Run, tmp_path: Path, others: str, status: int
) -> None:
    (tmp_path / 'broken.py').write_text(BROKEN)
    (tmp_path / 'node.py').write_text(others)
    outcome = run('check', '.')
    assert (outcome.status, 'broken.py:2' in outcome.out) == (status, True)
    assert 'CC500' in outcome.out


@pytest.mark.parametrize('command', ['check', 'spec'])
def test_a_broken_file_fails_with_strict(run: Run, tmp_path: Path, command: str) -> None:
    (tmp_path / 'broken.py').write_text(BROKEN)
    (tmp_path / 'node.py').write_text(CLEAN)
    assert run(command, '.', '--strict').status == 3
    (tmp_path / 'broken.py').unlink()
    assert run(command, '.', '--strict').status == 0


@pytest.mark.parametrize('command', ['check', 'spec'])
def test_a_path_of_which_nothing_can_be_read_is_an_error(
    run: Run, tmp_path: Path, command: str
) -> None:
    (tmp_path / 'package').mkdir()
    (tmp_path / 'package' / 'broken.py').write_text(BROKEN)
    (tmp_path / 'node.py').write_text(CLEAN)
    assert run(command, 'node.py', 'package').status == 2
    assert run(command, 'node.py', 'package/broken.py').status == 2
    assert run(command, '.').status == 0
