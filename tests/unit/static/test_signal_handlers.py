"""What handlers of signals set ends waits; the main program may wait for a signal alone."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.deeds import OUTSIDE

PROGRAM = """\
import signal
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor

class Ender:
    def __init__(self):
        self.done = threading.Event()

    def end(self, *_):
        self.finish()

    def finish(self):
        self.done.set()

rclpy.init()
node = rclpy.create_node('robot')
node.create_timer(0.1, lambda: None)
executor = MultiThreadedExecutor(2)
executor.add_node(node)
ender = Ender()
threading.Thread(target=executor.spin, daemon=True).start()
HANDLE
WAIT
"""
CAUGHT = 'try:\n    ender.done.wait()\nexcept KeyboardInterrupt:\n    pass'


@pytest.mark.parametrize(
    ('handle', 'wait', 'wakers', 'slugs'),
    [
        ('signal.signal(signal.SIGINT, ender.end)', 'ender.done.wait()', [OUTSIDE], []),
        (
            'signal.signal(signal.SIGTERM, lambda *_: ender.done.set())',
            'ender.done.wait()',
            [OUTSIDE],
            [],
        ),
        ('', 'ender.done.wait()', [], ['nobody-spins']),
        ('', CAUGHT, [OUTSIDE], []),
        ('', 'threading.Event().wait()', [OUTSIDE], []),
    ],
)
def test_who_ends_the_wait_of_main(
    handle: str, wait: str, wakers: list[str], slugs: list[str]
) -> None:
    text = PROGRAM.replace('HANDLE', handle).replace('WAIT', wait)
    if wait != 'ender.done.wait()' or not handle:
        text = text.replace('self.done.set()', 'pass')
    extraction = scan_text(text)
    (unit,) = extraction.units
    (main,) = (each for each in unit.activities if each.name == 'main')
    (block,) = main.blocking
    assert [waker.by for waker in block.wakers] == wakers
    assert [each.slug for each in extraction.diagnostics] == slugs


def test_a_handler_is_no_waker_that_may_be_left_out() -> None:
    """A callback that would end the wait too is still asked for."""
    text = PROGRAM.replace('HANDLE', '').replace('WAIT', CAUGHT)
    text = text.replace('lambda: None', 'lambda: ender.finish()')
    text = text.replace('ender = Ender()', '').replace(
        'rclpy.init()', 'ender = Ender()\nrclpy.init()'
    )
    (unit,) = scan_text(text).units
    (main,) = (each for each in unit.activities if each.name == 'main')
    (timer,) = unit.callbacks
    assert [[waker.by for waker in block.wakers] for block in main.blocking] == [[timer.name]]
