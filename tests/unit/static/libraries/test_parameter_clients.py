"""The clients of an ``AsyncParameterClient`` are in a group, and their answers come there."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.model import EntityKind

PROGRAM = """\
import time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.parameter_client import AsyncParameterClient

class Belt(Node):
    def __init__(self):
        super().__init__('belt')
        self.site = AsyncParameterClient(self, 'site'GROUP)
        self.create_timer(1.0, self.look)

    def look(self):
        future = self.site.get_parameters(['speed'])
        while not future.done():
            time.sleep(0.1)

rclpy.init()
rclpy.spin(Belt())
"""


@pytest.mark.parametrize(
    ('given', 'group'),
    [('', 'belt_default'), (', callback_group=ReentrantCallbackGroup()', None)],
)
def test_a_future_of_it_is_one_of_a_client(given: str, group: str | None) -> None:
    (unit,) = scan_text(PROGRAM.replace('GROUP', given)).units
    (client,) = (each for each in unit.callbacks if each.entity is EntityKind.CLIENT)
    (look,) = (each for each in unit.callbacks if each.name == 'look')
    assert client.key == 'site/get_parameters'
    assert (client.group == look.group) is (group is not None)
    assert [block.on for block in look.blocking if block.call == 'busy wait'] == [client.name]
