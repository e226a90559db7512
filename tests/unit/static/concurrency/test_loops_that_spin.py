"""``main`` spins in a loop, and works, until a callback has stored what the loop looks at."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import Blocking

PROGRAM = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.answered = False
        self.asked = self.create_publisher(Empty, 'ask', 10)
        self.create_subscription(Empty, 'answer', self.on_answer, 10)

    def on_answer(self, msg):
        ANSWERED

    def ask(self):
        self.asked.publish(Empty())
        ASKED

    def wait(self):
        while not self.answered:
            self.ask()
            rclpy.spin_once(self, timeout_sec=1.0)
            ENDS

def main():
    rclpy.init()
    asker = Asker()
    asker.wait()

if __name__ == '__main__':
    main()
"""
SETS = 'self.answered = True'


def wait(answered: str = SETS, asked: str = 'pass', ends: str = 'pass') -> Blocking:
    text = PROGRAM.replace('ANSWERED', answered).replace('ASKED', asked).replace('ENDS', ends)
    (unit,) = scan_text(text).units
    (found,) = [each for each in unit.set_up if each.call == 'polling loop']
    return found


def test_the_callback_that_stores_it_ends_the_loop() -> None:
    found = wait()
    assert [each.by for each in found.wakers] == ['on_answer']
    assert (found.seconds, found.escapes) == (None, None)


def test_that_nobody_stores_it_is_told() -> None:
    assert wait(answered='pass').escapes is not None


@pytest.mark.parametrize(
    ('asked', 'ends'),
    [(SETS, 'pass'), ('pass', SETS), ('pass', 'if self.count:\n                break')],
)
def test_a_loop_that_may_end_itself_is_left_open(asked: str, ends: str) -> None:
    found = wait(answered='pass', asked=asked, ends=ends)
    assert found.seconds is not None
