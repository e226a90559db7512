"""A child that was killed ends, and a pipe that does not block gives what there is."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import fcntl
import os
import signal
import subprocess
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty


class Player(Node):
    def __init__(self):
        super().__init__('player')
        self.child = subprocess.Popen(['play'], stdout=subprocess.PIPE)
        self.create_subscription(Empty, 'stop', self.on_stop, 10)

    def on_stop(self, msg):
        {}


rclpy.init()
rclpy.spin(Player())
"""
KILL_ALL = 'os.killpg(os.getpgid(self.child.pid), signal.SIGKILL)'
TRY = f'try:\n    {KILL_ALL}\nexcept ProcessLookupError:\n    self.child.kill()\n'
NUMBER = 'number = self.child.stdout.fileno()\n'


def waits(does: str) -> list[str]:
    units = scan_text(PROGRAM.format(does.replace('\n', '\n        '))).units
    return [block.call for unit in units for each in unit.callbacks for block in each.blocking]


@pytest.mark.parametrize(
    'does',
    [
        'self.child.kill()\nself.child.wait()',
        f'{KILL_ALL}\nself.child.wait()',
        f'{TRY}self.child.wait()',
        f'{NUMBER}fcntl.fcntl(number, fcntl.F_SETFL, os.O_NONBLOCK)\nself.child.stdout.read()',
        'os.set_blocking(self.child.stdout.fileno(), False)\nself.child.stdout.read()',
    ],
)
def test_what_ends_or_does_not_block_is_no_wait(does: str) -> None:
    assert waits(does) == []


@pytest.mark.parametrize(
    ('does', 'waited'),
    [
        ('self.child.terminate()\nself.child.wait()', ['Popen.wait']),
        ('os.kill(self.child.pid, signal.SIGTERM)\nself.child.wait()', ['Popen.wait']),
        ('if msg is None:\n    self.child.kill()\nself.child.wait()', ['Popen.wait']),
        ('self.child.wait()\nself.child.kill()', ['Popen.wait']),
        ('self.child.kill()\nself.child.communicate()', ['Popen.communicate']),
        ('self.child.stdout.read()', ['BufferedReader.read']),
    ],
)
def test_other_ends_are_waited_for(does: str, waited: list[str]) -> None:
    assert waits(does) == waited
