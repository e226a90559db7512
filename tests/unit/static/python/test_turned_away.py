"""What is done behind a test that raises rests on it; the end of a ``with`` does what it does."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Turn:
    def __init__(self):
        self.taken = False

    def __enter__(self):
        if self.taken:
            {turn_away}
        self.taken = True

    def __exit__(self, *_):
        self.taken = False

class Door(Node):
    def __init__(self):
        super().__init__('door')
        self.turn = Turn()
        self.create_service(
            Trigger, 'open', self.on_open, callback_group=ReentrantCallbackGroup())

    def on_open(self, request, response):
        with self.turn:
            self.opened = 1
        return response

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Door())
executor.spin()
"""
HELD = ('Turn.taken (flag)',)


@pytest.mark.parametrize(
    ('turn_away', 'held'),
    # Who returns there goes on with the block.
    [("raise RuntimeError('taken')", HELD), ('return', ())],
)
def test_who_has_found_a_flag_down_has_put_it_up_until_the_block_ends(
    turn_away: str, held: tuple[str, ...]
) -> None:
    (unit,) = scan_text(PROGRAM.format(turn_away=turn_away)).units
    (on_open,) = unit.callbacks
    assert [(w.name, w.rests, w.lowers, w.locks) for w in on_open.writes] == [
        ('Turn.taken', True, False, HELD),
        ('Door.opened', False, False, held),
        ('Turn.taken', False, True, held),
    ]


def test_what_stands_before_the_test_does_not_rest_on_it() -> None:
    text = PROGRAM.replace('        if self.taken:\n            {turn_away}\n', '')
    (unit,) = scan_text(text).units
    assert [w.rests for w in unit.callbacks[0].writes] == [False, False, False]
