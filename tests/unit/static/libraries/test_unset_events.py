"""Events that nobody sets, and what stands behind them."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.node import Node

class Stream(Node):
    def __init__(self):
        super().__init__('stream')
        self.leaving = threading.Event()
        self.create_timer(1.0, self.on_timer)
        SET_UP

    def on_timer(self):
        if not self.leaving.is_set():
            return
        self.leaving.clear()
        time.sleep(3)

    def leave(self):
        LEAVE

def main():
    rclpy.init()
    stream = Stream()
    MAIN
    rclpy.spin(stream)

if __name__ == '__main__':
    main()
"""


def sleeps(set_up: str = 'pass', leave: str = 'pass', main: str = 'pass') -> bool:
    text = PROGRAM.replace('SET_UP', set_up).replace('LEAVE', leave).replace('MAIN', main)
    units = scan_text(text).units
    return any(each.blocking for unit in units for each in unit.callbacks)


@pytest.mark.parametrize(
    'set_up', ['pass', 'self.leaving.clear()', 'print(self.leaving.is_set())', '# leaving.set()']
)
def test_nothing_happens_behind_an_event_that_nobody_sets(set_up: str) -> None:
    assert not sleeps(set_up)


@pytest.mark.parametrize(
    ('set_up', 'leave', 'main'),
    [
        ('self.leaving.set()', 'pass', 'pass'),
        ('pass', 'self.leaving.set()', 'pass'),
        ('pass', 'pass', 'stream.leaving.set()'),
        ('pass', 'pass', 'threading.Timer(1.0, stream.leaving.set).start()'),
        ('pass', 'pass', "getattr(stream, 'leaving').set()"),
        ('other = self.leaving\n        other.set()', 'pass', 'pass'),
        ('self.all = [self.leaving]', 'pass', 'pass'),
        ('self.leaving = self.gone = threading.Event()', 'self.gone.set()', 'pass'),
        ('self.leaving = (gone := threading.Event())', 'self.leaving.set()', 'pass'),
    ],
)
def test_somebody_sets_it_or_may_have_it_by_another_name(
    set_up: str, leave: str, main: str
) -> None:
    assert sleeps(set_up, leave, main)
