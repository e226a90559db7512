"""Chains of states that a callback goes through: followed to the end, or said to be cut."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan

HEAD = """
import rclpy
from rclpy.node import Node


class Machine(Node):
    def __init__(self):
        super().__init__('machine')
        self.state = State0()
        self.create_timer(0.1, self.update)

    def update(self):
        self.state = self.state.loop(self)
"""
STATE = """

class State{number}:
    def loop(self, node):
        node.create_subscription(str, 'topic{number}', print, 10)
        return {following}()
"""
FOOT = """

rclpy.init()
rclpy.spin(Machine())
"""


def machine_of(states: int) -> str:
    bodies = [
        STATE.format(number=n, following=f'State{n + 1}' if n + 1 < states else 'Machine')
        for n in range(states)
    ]
    return HEAD + ''.join(bodies) + FOOT


@pytest.mark.parametrize('states', [1, 2, 8])
def test_short_chains_are_followed_to_their_end(states: int, tmp_path: Path) -> None:
    (tmp_path / 'node.py').write_text(machine_of(states))
    (unit,) = (u for u in scan([tmp_path]).units if u.executor.spun)
    topics = [callback.key for callback in unit.callbacks if callback.key]
    assert topics == [f'topic{number}' for number in range(states)]


@pytest.mark.parametrize('states', [14, 40])
def test_of_long_ones_the_unit_says_that_it_is_incomplete(states: int, tmp_path: Path) -> None:
    (tmp_path / 'node.py').write_text(machine_of(states))
    (unit,) = (u for u in scan([tmp_path]).units if u.executor.spun)
    assert 'entities' in {fact.fact for fact in unit.unresolved}
