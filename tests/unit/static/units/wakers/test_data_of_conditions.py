"""Conditions that are notified of other data than a wait asks for."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.node import Node

class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.changed = threading.Condition()
        self.left, self.right, self.items = 0, 0, []
        self.create_timer(0.1, self.tell_left)
        self.create_timer(0.1, self.tell_right)
        self.create_timer(0.1, self.take)

    def tell_left(self):
        with self.changed:
            self.left += 1
            self.changed.notify_all()

    def tell_right(self):
        TELLS

    def take(self):
        with self.changed:
            WAITS

rclpy.init()
rclpy.spin(Waiter())
"""
RIGHT = """with self.changed:
            self.right += 1
            self.changed.notify_all()"""


def wakers(waits: str, tells: str = RIGHT) -> tuple[list[str], str | None]:
    """What ends the wait, and why that is not known."""
    (unit,) = scan_text(PROGRAM.replace('WAITS', waits).replace('TELLS', tells)).units
    (take,) = (each for each in unit.callbacks if each.function_name == 'take')
    (wait,) = take.blocking
    return [waker.by for waker in wait.wakers], wait.escapes and wait.escapes.reason


@pytest.mark.parametrize(
    'waits',
    [
        'self.changed.wait_for(lambda: self.right > 0)',
        'self.changed.wait_for(lambda: not not self.right)\n            self.right -= 1',
        'while not self.right:\n                self.changed.wait()',
        'while self.right < 1:\n                self.changed.wait()\n            self.right = 0',
    ],
)
def test_only_what_speaks_of_the_data_ends_a_wait_that_asks_again(waits: str) -> None:
    assert wakers(waits) == (['tell_right'], None)


@pytest.mark.parametrize(
    'waits',
    [
        'self.changed.wait()',
        'if not self.right:\n                self.changed.wait()',
        'self.changed.wait_for(self.is_there)',
        'self.changed.wait_for(lambda: self.right > self.limit())',
        'while not self.right and not self.limit():\n                self.changed.wait()',
    ],
)
def test_any_ends_one_that_does_not_or_that_asks_for_more(waits: str) -> None:
    assert wakers(waits)[0] == ['tell_left', 'tell_right']


def test_data_that_is_changed_without_a_word_may_be_told_of_by_another() -> None:
    found, _ = wakers('self.changed.wait_for(lambda: self.right > 0)', 'self.right += 1')
    assert found == ['tell_left']


def test_where_nobody_speaks_of_the_data_it_is_undecided() -> None:
    reason = 'no code that notifies it changes what the wait asks for'
    assert wakers('self.changed.wait_for(lambda: self.items)') == ([], reason)


@pytest.mark.parametrize(
    'waits',
    [
        'self.changed.wait_for(lambda: self.left and self.right)',
        'while not self.left or not self.right:\n                self.changed.wait()',
        'self.changed.wait_for(lambda: all((self.left, self.right)))',
    ],
)
def test_of_several_things_that_different_code_brings_one_is_not_enough(waits: str) -> None:
    found, reason = wakers(waits)
    assert set(found) <= {'tell_left', 'tell_right', 'outside'}
    assert reason == 'it asks for several things, which different code brings'


def test_one_of_several_things_may_be_enough() -> None:
    assert wakers('self.changed.wait_for(lambda: self.left or self.right)') == (
        ['tell_left', 'tell_right'],
        None,
    )
