"""``next(…)`` of what is known gives one of its items."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import rclpy
from rclpy.node import Node

class Cell(Node):
    def __init__(self, name):
        super().__init__(name)

    def go(self):
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass

def find(nodes):
    return NEXT

rclpy.init()
cell = find([Cell('left')])
cell.go()
rclpy.spin(cell)
"""
FIRST = 'next(node for node in nodes if isinstance(node, Cell))'
WITH_DEFAULT = 'next((node for node in nodes if isinstance(node, Cell)), None)'


@pytest.mark.parametrize('found', [FIRST, WITH_DEFAULT, 'next(iter(nodes))'])
def test_an_item_of_what_is_known(found: str) -> None:
    (unit,) = scan_text(PROGRAM.replace('NEXT', found)).units
    assert [callback.name for callback in unit.callbacks] == ['tick']
