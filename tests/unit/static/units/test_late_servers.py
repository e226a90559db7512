"""Waits of the set-up for a service that only the code behind them makes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.api import scan

NODE = """\
import threading
import time

import rclpy
from elsewhere import prepare
from rclpy.action import ActionClient, ActionServer
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci

REMOTE = bool(prepare.remote)


class Server(Node):
    def __init__(self, **given):
        super().__init__('server', **given)
        self.create_service(Trigger, 'calib', self.on)

    def on(self, request, response):
        return response


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'calib')
        self.fib = ActionClient(self, Fibonacci, 'fib')
{body}

    def serve(self):
        self.service = self.create_service(Trigger, 'calib', self.on)

    def serve_action(self):
        self.server = ActionServer(self, Fibonacci, 'fib', self.execute)

    def until_there(self, client):
        while not client.wait_for_service(timeout_sec=1.0):
            self.get_logger().info('not there')

    def on(self, request, response):
        return response

    def execute(self, goal):
        return Fibonacci.Result()


def main():
    rclpy.init()
{main}


main()
"""
SPIN = ['rclpy.spin(Asker())']
POLL = ['while not self.client.service_is_ready():', '    time.sleep(0.1)']
BESIDE = [
    'asker = Asker()',
    'threading.Thread(target=rclpy.spin, args=(asker,), daemon=True).start()',
    'asker.client.wait_for_service()',
]
WAIT, SERVE = 'self.client.wait_for_service()', 'self.serve()'

_OPEN = r'the \w+ .* may be made only behind the wait|whether another thread has made'


def _scanned(tmp_path: Path, body: list[str], main: list[str]) -> Extraction:
    path = tmp_path / 'asker.py'
    lines = '\n'.join(8 * ' ' + line for line in body)
    path.write_text(NODE.format(body=lines, main='\n'.join(4 * ' ' + line for line in main)))
    return scan([path])


def _reasons(found: Extraction) -> list[str]:
    waits = (wait for unit in found.units for wait in unit.set_up)
    reasons = [wait.escapes.reason for wait in waits if wait.escapes is not None]
    return [each for each in reasons if re.match(_OPEN, each)]


@pytest.mark.parametrize(
    ('body', 'main'),
    [
        ([WAIT, SERVE], SPIN),
        ([*POLL, SERVE], SPIN),
        (['while not self.client.wait_for_service(1.0):', '    pass', SERVE], SPIN),
        (['while rclpy.ok() and not self.client.service_is_ready():', '    pass', SERVE], SPIN),
        (
            [
                'there = False',
                'while not there:',
                '    there = self.client.wait_for_service(timeout_sec=1.0)',
                SERVE,
            ],
            SPIN,
        ),
        (
            [
                'while True:',
                '    if self.client.wait_for_service(timeout_sec=1.0):',
                '        break',
                SERVE,
            ],
            SPIN,
        ),
        (
            [
                'while not self.client.service_is_ready():',
                '    rclpy.spin_once(self, timeout_sec=0.1)',
                SERVE,
            ],
            SPIN,
        ),
        (['self.until_there(self.client)', SERVE], SPIN),
        (['self.fib.wait_for_server()', 'self.serve_action()'], SPIN),
        (
            [
                'while not self.fib.server_is_ready():',
                '    time.sleep(0.1)',
                'self.serve_action()',
            ],
            SPIN,
        ),
        (POLL, ['asker = Asker()', 'server = Server()', 'rclpy.spin(server)']),
        (
            ['pass'],
            ['asker = Asker()', 'asker.client.wait_for_service()', 'rclpy.spin(Server())'],
        ),
        ([WAIT, 'self.create_timer(1.0, self.serve)'], SPIN),
        (['pass'], [*BESIDE, 'rclpy.spin(Server())']),
        (['pass'], [*BESIDE, 'server = Server()', 'while rclpy.ok():', '    time.sleep(1.0)']),
        (
            [
                'future = self.client.call_async(Trigger.Request())',
                'rclpy.spin_until_future_complete(self, future)',
                SERVE,
            ],
            SPIN,
        ),
    ],
)
def test_a_wait_for_what_only_the_code_behind_it_makes_never_ends(
    tmp_path: Path, body: list[str], main: list[str]
) -> None:
    found = _scanned(tmp_path, body, main)

    (told,) = [each for each in found.diagnostics if each.slug == 'nobody-spins']
    assert 'which the program itself makes only behind this wait' in told.message
    text = (tmp_path / 'asker.py').read_text().splitlines()
    (made,) = {each.place.line for each in told.related}
    assert 'create_service' in text[made - 1] or 'ActionServer(' in text[made - 1]


@pytest.mark.parametrize(
    ('body', 'main'),
    [
        ([SERVE, WAIT], SPIN),
        ([SERVE, *POLL], SPIN),
        (POLL, ['server = Server()', 'asker = Asker()', 'rclpy.spin(server)']),
        (POLL, SPIN),
        (POLL, ['asker = Asker()', "server = Server(namespace='other')", 'rclpy.spin(server)']),
        (['if REMOTE:', '    ' + WAIT, 'else:', '    ' + SERVE], SPIN),
        (['self.client.wait_for_service(timeout_sec=5.0)', SERVE], SPIN),
        (
            [
                'for _ in range(5):',
                '    if self.client.wait_for_service(timeout_sec=1.0):',
                '        break',
                SERVE,
            ],
            SPIN,
        ),
        (
            [
                'tries = 0',
                'while not self.client.wait_for_service(timeout_sec=1.0):',
                '    tries += 1',
                '    if tries > 3:',
                '        break',
                SERVE,
            ],
            SPIN,
        ),
    ],
)
def test_what_is_there_before_or_made_elsewhere_ends_the_wait(
    tmp_path: Path, body: list[str], main: list[str]
) -> None:
    found = _scanned(tmp_path, body, main)

    assert [each for each in found.diagnostics if each.slug == 'nobody-spins'] == []
    assert _reasons(found) == []


@pytest.mark.parametrize(
    'body',
    [
        ['threading.Thread(target=self.serve).start()', WAIT],
        [WAIT, 'if REMOTE:', '    ' + SERVE],
        ['if REMOTE:', '    ' + WAIT, SERVE],
        ['prepare(self)', WAIT, SERVE],
    ],
)
def test_where_the_order_is_not_known_the_wait_is_undecided(
    tmp_path: Path, body: list[str]
) -> None:
    found = _scanned(tmp_path, body, SPIN)

    assert [each for each in found.diagnostics if each.slug == 'nobody-spins'] == []
    assert len(set(_reasons(found))) == 1


POLL_BESIDE = """\
import threading
import time

import rclpy
from rclpy.node import Node


class Other(Node):
    def __init__(self):
        super().__init__('other')


class Watcher(Node):
    def __init__(self):
        super().__init__('watcher')
        self.ready = False
        self.create_timer(0.1, self.tick)
        while not self.ready:
            time.sleep(0.1)

    def tick(self):
        self.ready = True


rclpy.init()
threading.Thread(target=rclpy.spin, args=(Other(),), daemon=True).start()
watcher = Watcher()
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(watcher)
executor.spin()
"""


def test_a_loop_of_main_beside_a_thread_is_told_where_main_spins_later(tmp_path: Path) -> None:
    path = tmp_path / 'watcher.py'
    path.write_text(POLL_BESIDE)

    found = scan([path])

    waits = [wait for unit in found.units for wait in unit.set_up if wait.call == 'polling loop']
    assert len(waits) == 1 and waits[0].escapes is not None
