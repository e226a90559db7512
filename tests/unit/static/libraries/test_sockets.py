"""Where sockets come from that nobody makes by their class, and how long they wait."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import socket
import rclpy
from rclpy.node import Node


class Bridge(Node):
    def __init__(self):
        super().__init__('bridge')
        self.server = socket.create_server(('', 5000))
        self.create_timer(0.5, self.read)

    def read(self):
        {}


rclpy.init()
rclpy.spin(Bridge())
"""


@pytest.mark.parametrize(
    ('lines', 'waits'),
    [
        (
            "peer = socket.create_connection(('robot', 5000)); peer.recv(10)",
            [('socket.create_connection', None), ('socket.recv', None)],
        ),
        (
            "peer = socket.create_connection(('robot', 5000), 2.0); peer.recv(10)",
            [('socket.create_connection', 2.0), ('socket.recv', 2.0)],
        ),
        (
            "peer = socket.create_connection(('robot', 5000), timeout=2.0)\n"
            '        peer.settimeout(None); peer.recv(10)',
            [('socket.create_connection', 2.0), ('socket.recv', None)],
        ),
        (
            'peer, address = self.server.accept(); peer.recv(10)',
            [('socket.accept', None), ('socket.recv', None)],
        ),
        (
            'self.server.settimeout(1.0); peer, address = self.server.accept(); peer.recv(10)',
            [('socket.accept', 1.0), ('socket.recv', None)],
        ),
        # A stream sends as fast as its peer reads; a datagram goes, whoever reads it.
        (
            "peer, address = self.server.accept(); peer.sendall(b'x')",
            [('socket.accept', None), ('socket.sendall', None)],
        ),
        ("socket.socket(type=socket.SOCK_DGRAM).send(b'x')", []),
        (
            "peer = socket.create_connection(('robot', 5000), 2.0); peer.send(b'x')",
            [('socket.create_connection', 2.0), ('socket.send', 2.0)],
        ),
    ],
)
def test_what_a_socket_waits_for_is_known(
    lines: str, waits: list[tuple[str, float | None]]
) -> None:
    (unit,) = scan_text(PROGRAM.format(lines)).units
    (read,) = unit.callbacks
    found = {(block.call, block.seconds) for block in read.blocking}
    assert found == set(waits)
    assert all(block.wakers[0].by == 'outside' for block in read.blocking)
