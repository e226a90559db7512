"""A loop over an enumeration goes over its members: what is made for each of them is known."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import threading
from enum import Enum, IntEnum
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Contact(KIND):
    OPEN = 0
    CLOSED = 1
    SHUT = 1

class Dock(Node):
    def __init__(self):
        super().__init__('dock')
        self.events = MADE
        self.create_subscription(String, 'dock', self.on_dock, 10)
        self.create_subscription(String, 'contact', self.on_contact, 10)

    def on_dock(self, msg):
        self.events[Contact.CLOSED].wait()

    def on_contact(self, msg):
        self.events[Contact.SET].set()

rclpy.init()
rclpy.spin(Dock())
"""
MADE = [
    '{each: threading.Event() for each in Contact}',
    'dict((each, threading.Event()) for each in Contact)',
    'dict(zip(Contact, [threading.Event(), threading.Event()]))',
]


@pytest.mark.parametrize('made', MADE)
@pytest.mark.parametrize(('stored', 'by'), [('CLOSED', ['on_contact']), ('SHUT', ['on_contact'])])
def test_the_wait_for_an_item_has_its_own_waker(made: str, stored: str, by: list[str]) -> None:
    text = PROGRAM.replace('MADE', made).replace('SET', stored).replace('KIND', 'Enum')
    wait = scan_text(text).units[0].callbacks[0].blocking[0]
    assert [waker.by for waker in wait.wakers] == by


@pytest.mark.parametrize('made', MADE)
def test_another_item_does_not_end_it(made: str) -> None:
    text = PROGRAM.replace('MADE', made).replace('SET', 'OPEN').replace('KIND', 'Enum')
    wait = scan_text(text).units[0].callbacks[0].blocking[0]
    assert wait.call == 'Event.wait'
    assert wait.wakers == ()


def test_one_of_numbers_is_left_open() -> None:
    text = PROGRAM.replace('MADE', MADE[0]).replace('SET', 'CLOSED').replace('KIND', 'IntEnum')
    wait = scan_text(text).units[0].callbacks[0].blocking[0]
    assert wait.call == 'unknown wait'
