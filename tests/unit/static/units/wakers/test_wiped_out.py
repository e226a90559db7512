"""An event that is cleared between a message and the wait for what the message brings."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Board(Node):
    def __init__(self):
        super().__init__('board')
        self.pub = self.create_publisher(Empty, 'done', 10)
        self.create_subscription(Empty, '/go', self.on_go, 10)
        self.create_timer(1.0, self.tick)

    def on_go(self, msg):
        ANSWERS

    def tick(self):
        TICKS

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.event = threading.Event()
        self.pub = self.create_publisher(Empty, 'go', 10)
        self.other = self.create_publisher(Empty, 'other', 10)
        self.create_subscription(Empty, 'done', self.on_done, 10)

    def on_done(self, msg):
        self.event.set()

    def ask(self):
        ASKS

def main():
    rclpy.init()
    asker = Asker()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(asker)
    executor.add_node(Board())
    threading.Thread(target=executor.spin, daemon=True).start()
    for number in range(3):
        asker.ask()

main()
"""
SENT, CLEARED, WAITS = 'self.pub.publish(Empty())', 'self.event.clear()', 'self.event.wait()'
LATE = f'{SENT}; {CLEARED}; {WAITS}'


def why(asks: str, answers: str = SENT, ticks: str = 'pass') -> str | None:
    text = PROGRAM.replace('ASKS', asks).replace('ANSWERS', answers).replace('TICKS', ticks)
    (unit,) = scan_text(text).units
    found = {
        wait.escapes.reason if wait.escapes is not None else None
        for activity in unit.activities
        for wait in activity.blocking
        if wait.call == 'Event.wait'
    }
    (reason,) = found
    return reason


TOLD = 'what ends it may come for the message on go that is sent before the clear'


def test_what_a_message_brings_may_be_wiped_out_by_a_clear_behind_it() -> None:
    assert why(LATE) == TOLD


def test_so_it_may_where_another_program_answers() -> None:
    assert why(LATE, 'pass') == TOLD


@pytest.mark.parametrize(
    'asks',
    [
        f'{CLEARED}; {SENT}; {WAITS}',
        f'{SENT}; {WAITS}; {CLEARED}',
        f'{SENT}; {CLEARED}; {SENT}; {WAITS}',
        f'{CLEARED}; {WAITS}',
        f'{SENT}; {CLEARED}; self.event.wait(1.0)',
    ],
)
def test_an_event_that_is_cleared_before_the_message_is_not(asks: str) -> None:
    assert why(asks) is None


def test_what_comes_by_itself_again_and_again_is_not() -> None:
    assert why(LATE, 'pass', SENT) is None
    assert why(LATE, SENT, SENT) is None


def test_a_message_that_brings_nothing_is_of_no_matter() -> None:
    other = LATE.replace('self.pub', 'self.other')
    assert why(other, SENT) is None


def warned(asks: str) -> list[tuple[str, int]]:
    text = PROGRAM.replace('ASKS', asks).replace('ANSWERS', SENT).replace('TICKS', 'pass')
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    return [(each.message, each.place.line) for each in found if each.code == 'CC109']


def test_the_wait_behind_such_a_clear_is_a_warning() -> None:
    ((message, line),) = warned(LATE)
    assert 'event, which is cleared after the message on go is sent' in message
    assert LATE in PROGRAM.replace('ASKS', LATE).splitlines()[line - 1]
    assert warned(f'{CLEARED}; {SENT}; {WAITS}') == []
