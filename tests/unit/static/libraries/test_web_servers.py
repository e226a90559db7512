"""Handlers of servers of the standard library run beside the callbacks."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.model import ActivityKind

PROGRAM = """
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer, ThreadingHTTPServer
from socketserver import BaseRequestHandler, ThreadingMixIn, TCPServer
import rclpy
from rclpy.node import Node

class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.seen = {}
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.seen[len(self.seen)] = 1

class Web(BaseHTTPRequestHandler):
    def do_GET(self):
        for tag in self.server.gate.seen:
            self.wfile.write(tag)

    def log_message(self, *args):
        self.server.gate.logged = True

class Raw(BaseRequestHandler):
    def handle(self):
        for tag in self.server.gate.seen:
            self.request.send(tag)

class Mixed(ThreadingMixIn, HTTPServer):
    pass

def main():
    rclpy.init()
    gate = Gate()
    server = SERVER(('', 0), HANDLER)
    server.gate = gate
    threading.Thread(target=server.serve_forever, daemon=True).start()
    rclpy.spin(gate)

main()
"""


def readers(server: str, handler: str = 'Web') -> list[tuple[ActivityKind, bool, list[str]]]:
    """Each thread: its kind, whether there may be several, and what it goes over."""
    (unit,) = scan_text(PROGRAM.replace('SERVER', server).replace('HANDLER', handler)).units
    return [
        (each.kind, each.count != 1, [read.name for read in each.reads if read.iterates])
        for each in unit.activities
    ]


@pytest.mark.parametrize('server', ['ThreadingHTTPServer', 'Mixed'])
def test_each_request_has_a_thread_of_its_own(server: str) -> None:
    assert (ActivityKind.THREAD, True, ['Gate.seen']) in readers(server)


def test_a_plain_server_answers_on_its_own_thread() -> None:
    assert readers('HTTPServer') == [(ActivityKind.THREAD, False, ['Gate.seen'])]
    assert readers('TCPServer', 'Raw') == [(ActivityKind.THREAD, False, ['Gate.seen'])]


def test_a_class_that_is_not_known_is_left_alone() -> None:
    assert [over for _, _, over in readers('HTTPServer', 'handlers[0]')] in ([], [[]])
