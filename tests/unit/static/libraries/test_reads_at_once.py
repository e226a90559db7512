"""Reads that give what there is: of sockets that are set so, and of regular files."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import os
import socket
import stat
import rclpy
from rclpy.node import Node

class Link(Node):
    def __init__(self):
        super().__init__('link')
        self.socket = socket.create_connection(('robot', 30003))
        self.path = self.get_parameter('path').value
        self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        DOES

rclpy.init()
rclpy.spin(Link())
"""
OPENED = 'file = os.open(self.path, os.O_RDONLY)\n        '
READ = 'print(os.read(file, 100))'
ASKED = 'if not stat.S_ISREG(os.lstat(self.path).st_mode):\n            return\n        '


@pytest.mark.parametrize(
    ('does', 'waits'),
    [
        ('self.socket.recv(4096)', ['socket.recv']),
        ('self.socket.recv(4096, socket.MSG_PEEK)', ['socket.recv']),
        ('self.socket.recv(4096, socket.MSG_DONTWAIT)', []),
        ('self.socket.recvfrom(4096, socket.MSG_DONTWAIT)', []),
        ('self.socket.recv(4096, flags=socket.MSG_DONTWAIT)', []),
        (f'{OPENED}{READ}', ['os.read']),
        (f'{ASKED}{OPENED}{READ}', []),
    ],
)
def test_a_read_waits_unless_it_is_told_or_asked_before(does: str, waits: list[str]) -> None:
    units = scan_text(PROGRAM.replace('DOES', does)).units
    found = [block.call for unit in units for each in unit.callbacks for block in each.blocking]
    assert found == waits


KEYS = """\
import select
import sys
import rclpy
from rclpy.node import Node

class Keys(Node):
    def __init__(self):
        super().__init__('keys')
        self.create_timer(0.1, self.on_timer)

    def has_key(self):
        return select.select([sys.stdin], [], [], 0) == ([sys.stdin], [], [])

    def is_open(self):
        return sys.stdin.isatty()

    def key(self):
        return sys.stdin.read(1)

    def key_if_any(self):
        return self.key() if self.has_key() else None

    def on_timer(self):
        DOES

rclpy.init()
rclpy.spin(Keys())
"""


@pytest.mark.parametrize(
    ('does', 'waits'),
    [
        ('if self.has_key():\n            print(sys.stdin.read(1))', []),
        ('if not self.has_key():\n            return\n        print(sys.stdin.read(1))', []),
        ('print(self.key_if_any())', []),
        ('if self.is_open():\n            print(sys.stdin.read(1))', ['sys.stdin.read']),
        ('self.has_key()\n        print(sys.stdin.read(1))', ['sys.stdin.read']),
        ('print(self.key())', ['sys.stdin.read']),
    ],
)
def test_another_function_may_have_asked(does: str, waits: list[str]) -> None:
    units = scan_text(KEYS.replace('DOES', does)).units
    found = [block.call for unit in units for each in unit.callbacks for block in each.blocking]
    assert found == waits
