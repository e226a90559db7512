"""Functions that code which is not scanned has may run beside the callbacks: nothing is proven."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.promises import Promise, judge
from ros2cc_extract.findings.races.handed_functions import races_with_others
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.yaml.yaml_io import read_specs, write_specs
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

PROGRAM = """\
import broker
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Bridge(Node):
    def __init__(self):
        super().__init__('bridge')
        self.pending = {}
        self.latest = None
        self.out = self.create_publisher(String, 'out', 10)
        self.create_timer(0.1, self.tick)
        client = broker.Client()
        HANDED

    def on_message(self, topic, payload=''):
        STORED

    def tick(self):
        for topic, payload in self.pending.items():
            self.out.publish(String(data=payload))
        if self.latest is not None:
            print('latest')
            self.latest.show()
        CALLED

rclpy.init()
rclpy.spin(Bridge())
"""
ADDED = 'self.pending[topic] = payload'
KEPT = ''


def told(handed: str, stored: str, called: str = 'pass') -> str:
    text = PROGRAM.replace('HANDED', handed).replace('STORED', stored).replace('CALLED', called)
    [unit] = scan_text(text, 'bridge.py').units
    assert read_specs(write_specs([unit]), 'bridge.yaml') == (unit,)
    verification = verify_unit(close(unit), Options(profile=Profile.RCLPY))
    judgements = {each.promise: each for each in judge(unit, verification, [])}
    return judgements[Promise.RACES].reason


@pytest.mark.parametrize(
    ('handed', 'name'),
    [
        ('client.on_message = self.on_message', 'broker.Client(…).on_message'),
        ('client.subscribe("all", self.on_message)', 'client.subscribe'),
        ('broker.listen(on_message=self.on_message)', 'broker.listen'),
        ('broker.listen(lambda topic: self.on_message(topic))', 'broker.listen'),
    ],
)
@pytest.mark.parametrize(
    ('stored', 'what'), [(ADDED, 'pending'), ('self.latest = None', 'latest')]
)
def test_what_a_callback_goes_over_or_tests_is_not_safe(
    handed: str, name: str, stored: str, what: str
) -> None:
    reason = told(handed, stored)
    assert f'is handed to {name}, which is not scanned' in reason
    assert reason.endswith(f'beside Bridge.tick, and both use Bridge.{what}')


@pytest.mark.parametrize(
    ('handed', 'stored', 'called'),
    [
        ('pass', ADDED, 'pass'),
        ('client.on_message = self.on_message', 'self.latest = topic', 'pass'),
        ('client.on_message = self.on_message', 'print(self.latest)', 'pass'),
        ('client.on_message = self.on_message', ADDED, 'self.on_message("now")'),
        ('print(sorted([1, 2], key=self.on_message))', ADDED, 'pass'),
    ],
)
def test_what_harms_nothing_or_is_called_by_the_program_leaves_it_proven(
    handed: str, stored: str, called: str
) -> None:
    assert told(handed, stored, called) == KEPT


LOOP = """\
import asyncio
import threading
import broker
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Bridge(Node):
    def __init__(self):
        super().__init__('bridge')
        self.clients = set()
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever, daemon=True).start()
        self.create_subscription(Empty, 'in', self.on_message, 10)
        broker.serve(self.serve)

    def on_message(self, msg):
        asyncio.run_coroutine_threadsafe(self.send(), self.loop)
        IN_CALLBACK

    async def send(self):
        for client in self.clients:
            await client.send('x')

    ASYNC def serve(self, client):
        self.clients.add(client)

rclpy.init()
rclpy.spin(Bridge())
"""


@pytest.mark.parametrize(
    ('marked', 'in_callback', 'is_open'),
    [
        ('async', 'pass', False),
        ('', 'pass', True),
        ('async', 'print([client for client in self.clients])', True),
    ],
)
def test_coroutines_of_one_loop_take_turns(marked: str, in_callback: str, is_open: bool) -> None:
    text = LOOP.replace('ASYNC', marked).replace('IN_CALLBACK', in_callback)
    [unit] = scan_text(text.replace('     def serve', '    def serve'), 'bridge.py').units
    assert bool([*races_with_others(unit)]) is is_open


def test_following_such_a_function_adds_nothing_else_to_the_unit() -> None:
    first, second = (
        scan_text(PROGRAM.replace('HANDED', each).replace('STORED', ADDED).replace('CALLED', ''))
        for each in ('client.on_message = self.on_message', 'pass')
    )
    [first], [second] = first.units, second.units
    assert [each.name for each in first.handed] == ['on_message']
    assert not second.handed
    assert (first.callbacks, first.activities, first.unresolved) == (
        second.callbacks,
        second.activities,
        second.unresolved,
    )
