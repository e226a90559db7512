"""A ``collections.defaultdict`` puts in what is asked for: that changes its size."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
from collections import defaultdict
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Counter(Node):
    def __init__(self):
        super().__init__('counter')
        self.known = {known}
        self.create_subscription(String, 'names', self.on_name, 10)

    def on_name(self, msg):
        {use}

def main():
    rclpy.init()
    rclpy.spin(Counter())
"""


@pytest.mark.parametrize(
    ('known', 'use', 'is_put_in'),
    [
        ('defaultdict(list)', 'self.known[msg.data].append(msg)', True),
        ('defaultdict(list)', 'print(self.known[msg.data])', True),
        ('defaultdict(list)', 'print(self.known.get(msg.data))', False),
        ('defaultdict()', 'print(self.known[msg.data])', False),
        ('dict(a=[])', "self.known['a'].append(msg)", False),
    ],
)
def test_what_is_asked_for_by_its_key_is_put_in(known: str, use: str, is_put_in: bool) -> None:
    (unit,) = scan_text(PROGRAM.format(known=known, use=use)).units
    (callback,) = unit.callbacks
    puts = [w for w in callback.writes if w.name == 'Counter.known' and w.moves == 'adds']
    assert bool(puts) is is_put_in
