"""Callbacks that do not take what rclpy passes raise ``TypeError``: what they do never happens."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import socket
import rclpy
from functools import partial
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import SetBool


class Link(Node):
    def __init__(self):
        super().__init__('link')
        self.line = socket.socket()
        {}

    def timed(self, info: TimerInfo):
        self.line.recv(1)

    def none(self):
        self.line.recv(1)

    def one(self, first):
        self.line.recv(1)

    def two(self, first, second):
        self.line.recv(1)

    def three(self, first, second, third):
        self.line.recv(1)

    def any(self, *given):
        self.line.recv(1)


rclpy.init()
rclpy.spin(Link())
"""
TIMER = 'self.create_timer(1.0, {})'
SERVICE = "self.create_service(SetBool, 'power', {})"
SUBSCRIPTION = "self.create_subscription(String, 'text', {}, 10)"


def scanned(makes: str) -> tuple[list[str], list[str]]:
    extraction = scan_text(PROGRAM.format(makes))
    blocks = (b for unit in extraction.units for each in unit.callbacks for b in each.blocking)
    return [block.call for block in blocks], [told.slug for told in extraction.diagnostics]


@pytest.mark.parametrize(
    'makes',
    [
        SERVICE.format('self.one'),
        SERVICE.format('self.three'),
        SERVICE.format('lambda request: self.line.recv(1)'),
        SUBSCRIPTION.format('self.none'),
        SUBSCRIPTION.format('self.three'),
        TIMER.format('self.one'),  # only a parameter of type TimerInfo gets something
        TIMER.format('self.two'),
        TIMER.format('partial(self.two, 1)'),
        SUBSCRIPTION.format('partial(self.one, 1)'),
    ],
)
def test_what_cannot_be_called_is_told_and_not_followed(makes: str) -> None:
    assert scanned(makes) == ([], ['not-followed'])


@pytest.mark.parametrize(
    'makes',
    [
        SERVICE.format('self.two'),
        SERVICE.format('self.any'),
        SERVICE.format('partial(self.three, 1)'),
        SUBSCRIPTION.format('self.one'),
        SUBSCRIPTION.format('self.two'),  # the second gets the info of the message
        SUBSCRIPTION.format('partial(self.two, 1)'),
        SUBSCRIPTION.format('partial(self.two, second=1)'),
        SUBSCRIPTION.format('partial(self.three, *rclpy.bound())'),  # nobody knows how many
        TIMER.format('self.none'),
        TIMER.format('partial(self.two, 1, 2)'),
        TIMER.format('self.timed'),  # it gets the times of the call, from Kilted on
        SUBSCRIPTION.format('lambda msg, more=2: self.line.recv(1)'),
    ],
)
def test_what_can_be_called_is_followed(makes: str) -> None:
    assert scanned(makes) == (['socket.recv'], [])


@pytest.mark.parametrize(
    ('callback', 'takes'),
    [
        ('self.two', True),
        ('partial(self.three, 1)', True),
        ('partial(partial(self.three, 1), third=2)', False),
        ('partial(self.two, 1)', False),
        ('partial(self.three, *rclpy.bound())', False),
    ],
)
def test_what_needs_the_information_of_a_message_is_noted(callback: str, takes: bool) -> None:
    (unit,) = scan_text(PROGRAM.format(SUBSCRIPTION.format(callback))).units
    assert [each.takes_info for each in unit.callbacks] == [takes]
