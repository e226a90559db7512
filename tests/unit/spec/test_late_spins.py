"""A spin until a future may last on Humble, unless a timer surely has something served."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.late_spins import late_spins

NODE = """
import threading
import rclpy
from rclpy.node import Node
from rclpy.task import Future

class Loader(Node):
    def __init__(self, many):
        super().__init__('loader')
        {made}

    def tick(self):
        {tick}

    def beat(self):
        pass

def main(many=None):
    rclpy.init()
    node = Loader(many)
    done = Future()
    threading.Thread(target=done.set_result, args=('map',), daemon=True).start()
    rclpy.spin_until_future_complete(node, done)
    rclpy.spin(node)

main()
"""
GOES_ON = 'self.timer = self.create_timer(0.1, self.tick)'
BEATS = 'self.timer = self.create_timer(0.1, self.beat)'
ALONE, CANCELLED = 'pass', 'self.timer.cancel()'


def count(made: str, tick: str) -> int:
    (unit,) = scan_text(NODE.format(made=made, tick=tick), 'loader.py').units
    return len(list(late_spins(unit)))


@pytest.mark.parametrize(
    ('made', 'tick', 'late'),
    [
        ('pass', ALONE, 1),
        (GOES_ON, ALONE, 0),
        (GOES_ON, CANCELLED, 1),
        (GOES_ON, f'if self.count_publishers("a"): {CANCELLED}', 1),
        (f'{GOES_ON}; {CANCELLED}', ALONE, 1),
        (f'{BEATS}; self.create_guard_condition(self.tick)', CANCELLED, 1),
        ('self.create_timer(0.1, self.tick, autostart=False)', ALONE, 1),
        (f'if many: {GOES_ON}', ALONE, 1),
        (f'{GOES_ON}; self.create_timer(1.0, self.beat)', CANCELLED, 0),
    ],
    ids=[
        'no_timer',
        'goes_on',
        'cancels_itself',
        'may_cancel_itself',
        'cancelled_at_once',
        'another_cancels_it',
        'does_not_start',
        'made_on_a_branch',
        'another_goes_on',
    ],
)
def test_only_a_timer_that_surely_goes_on_ends_it(made: str, tick: str, late: int) -> None:
    assert count(made, tick) == late
