"""Handlers that are looked up by a name of which the source says only the beginning or the end."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Empty

class Base(Node):
    def do_call(self, name):
        self.client.call(Empty.Request())

class Router(Base):
    def __init__(self):
        super().__init__('router')
        self.client = self.create_client(Empty, 'remote')
        self.create_subscription(String, 'commands', self.on_command, 10)

    def on_command(self, msg):
        verb, _, name = msg.data.partition(' ')
        handler = getattr(self, NAME, None)
        if handler is not None:
            handler(name)

    def say(self, name):
        self.client.wait_for_service()

rclpy.init()
rclpy.spin(Router())
"""


@pytest.mark.parametrize(
    ('name', 'waits'),
    [
        ("f'do_{verb}'", ['client.call']),
        ("f'{verb}_call'", ['client.call']),
        ("f'do_{verb}_now'", []),
        ("f'{verb}'", ['unknown wait']),
        ("'do_' + verb", ['client.call']),
        ("'d' + 'o_' + verb", ['client.call']),
        ("verb + '_call'", ['client.call']),
        ("'do_' + verb + '_now'", []),
        ("'do_%s' % verb", ['client.call']),
        ("'do_%s_now' % verb", []),
    ],
)
def test_each_method_so_named_may_run(name: str, waits: list[str]) -> None:
    (unit,) = scan_text(PROGRAM.replace('NAME', name)).units
    callback = next(each for each in unit.callbacks if each.name == 'on_command')
    assert [block.call for block in callback.blocking] == waits
