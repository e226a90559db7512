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


ASKED = """
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Page:
    def __init__(self, client, title, turned):
        self.client = client
        self.title = title
        self.turned = turned

        self.text = None

    def on_answer(self, future):
        if not future.result().success:
            self.turned(self.title, None)
            return
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_read)
        self.turned(self.title, self.text)

    def on_read(self, future):
        self.text = future.result().message


class Book(Node):
    def __init__(self):
        super().__init__('book')
        self.titles = [Title('one'), Title('two'), Title('three')]
        self.page = None
        self.client = self.create_client(Trigger, 'turn')
        self.create_timer(1.0, self.turn)

    def turn(self):
        if self.titles:
            self.page = Page(self.client, self.titles.pop(0), self.turned)
            asked = self.client.call_async(Trigger.Request())
            asked.add_done_callback(self.page.on_answer)

    def turned(self, title, text):
        if title is self.page.title:
            self.turn()


class Title:
    def __init__(self, text):
        self.text = text


rclpy.init()
rclpy.spin(Book())
"""


def test_objects_that_each_run_makes_anew_come_to_an_end(tmp_path: Path) -> None:
    """Those that hold functions and objects as others before add nothing new."""
    (tmp_path / 'node.py').write_text(ASKED)
    (unit,) = (u for u in scan([tmp_path]).units if u.executor.spun)
    assert 'entities' not in {fact.fact for fact in unit.unresolved}


@pytest.mark.parametrize('states', [14, 40])
def test_of_long_ones_the_unit_says_that_it_is_incomplete(states: int, tmp_path: Path) -> None:
    (tmp_path / 'node.py').write_text(machine_of(states))
    (unit,) = (u for u in scan([tmp_path]).units if u.executor.spun)
    assert 'entities' in {fact.fact for fact in unit.unresolved}
