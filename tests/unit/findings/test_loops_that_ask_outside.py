"""CC120, CC121: loops whose test asks a device or a server by a method of the program's own."""

from __future__ import annotations

import pytest

from tests.help.cases import said

PROGRAM = """\
import socket
import subprocess
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool
from std_srvs.srv import Trigger


class Robot:
    def __init__(self):
        self.sock = socket.create_connection(('10.0.0.2', 44818), timeout=5.0)
        self.is_set = False

    def pose(self):
        self.sock.sendall(b'pose')
        return [float(v) for v in self.sock.recv(64).split()]

    def is_moving(self):
        ASKS


class Move(Node):
    def __init__(self):
        super().__init__('move')
        self.robot = Robot()
        self.create_service(Trigger, 'move', self.on_move)
        self.create_subscription(Bool, 'set', self.on_set, 10)

    def on_set(self, msg):
        self.robot.is_set = msg.data

    def on_move(self, request, response):
        LOOP
        return response


def main():
    rclpy.init()
    rclpy.spin(Move())


main()
"""
SOCKET = 'return any(v != 0.0 for v in self.pose())'
CHILD = "return subprocess.run(['moves'], timeout=5.0).returncode == 0"
MIXED = 'self.pose()\n        return not self.is_set'
LOOPS = [
    'while self.robot.is_moving():\n            time.sleep(0.1)',
    "while self.robot.is_moving():\n            self.get_logger().info('moves')",
    'while True:\n            if not self.robot.is_moving():\n                break\n'
    '            time.sleep(0.1)',
]


def codes(asks: str, loop: str) -> set[str]:
    found = said(PROGRAM.replace('ASKS', asks).replace('LOOP', loop))
    return {each.code for each in found} & {'CC109', 'CC120', 'CC121', 'CC104'}


@pytest.mark.parametrize('asks', [SOCKET, CHILD])
@pytest.mark.parametrize('loop', LOOPS)
def test_something_outside_ends_it(asks: str, loop: str) -> None:
    assert codes(asks, loop) == {'CC121'}


@pytest.mark.parametrize('loop', LOOPS)
def test_data_of_the_program_may_decide_as_well(loop: str) -> None:
    assert 'CC121' not in codes(MIXED, loop)
    assert codes(MIXED, loop)
