"""A handler of a signal that waits keeps the main thread, and what that would spin."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.source_locations import Unknown

PROGRAM = """
import signal
import threading

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.client = self.create_client(Trigger, 'stop')
        self.running = True
        self.worker = threading.Thread(target=self.work)
        self.worker.start()

    def work(self):
        while self.running:
            {works}

    def on_term(self, number, frame):
        self.running = False
        {handles}


rclpy.init()
node = Base()
signal.signal(signal.SIGTERM, node.on_term)
{spins}
"""
CALL = 'self.client.call(Trigger.Request())'
JOIN = 'self.worker.join()'
IDLE = 'pass'
MAIN = 'rclpy.spin(node)'
ASIDE = 'threading.Thread(target=rclpy.spin, args=(node,)).start()\nsignal.pause()'
START = 'a handler of a signal keeps the main thread, and '
UNSPUN = 'no known code spins node meanwhile'


def reasons(works: str, handles: str, spins: str) -> list[str]:
    (unit,) = scan_text(PROGRAM.format(works=works, handles=handles, spins=spins)).units
    escapes = [wait.escapes for wait in unit.set_up]
    return [each.reason for each in escapes if isinstance(each, Unknown)]


@pytest.mark.parametrize(
    ('works', 'handles', 'why'),
    [(IDLE, CALL, UNSPUN), (CALL, JOIN, f'thread work itself waits in client.call, and {UNSPUN}')],
    ids=['for an answer', 'for a thread that waits for one'],
)
def test_nothing_is_spun_while_it_waits(works: str, handles: str, why: str) -> None:
    assert reasons(works, handles, MAIN) == [START + why]


@pytest.mark.parametrize(
    ('works', 'handles', 'spins'),
    [
        (CALL, JOIN, ASIDE),
        (IDLE, CALL, ASIDE),
        (IDLE, JOIN, MAIN),
        (CALL, 'rclpy.shutdown()', MAIN),
        (CALL, 'self.worker.join(timeout=2.0)', MAIN),
    ],
    ids=['spun aside', 'answered aside', 'nobody is needed', 'it waits not', 'for some time'],
)
def test_else_nothing_is_open(works: str, handles: str, spins: str) -> None:
    assert reasons(works, handles, spins) == []
