"""What ends waits of the main program: handlers of signals, threads around their spin, Ctrl-C."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import OUTSIDE

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


SPINS = """\
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor

rclpy.init()
node = rclpy.create_node('robot')
node.create_timer(0.1, lambda: None)
executor = SingleThreadedExecutor()
executor.add_node(node)
ready, done = threading.Event(), threading.Event()

def spin():
    ready.set()
    try:
        executor.spin()
    finally:
        done.set()

threading.Thread(target=spin, daemon=True).start()
ready.wait()
done.wait()
"""


def test_what_a_thread_sets_around_its_spin_ends_waits() -> None:
    extraction = scan_text(SPINS)
    (unit,) = extraction.units
    (main,) = (each for each in unit.activities if each.name == 'main')
    assert [[waker.by for waker in block.wakers] for block in main.blocking] == [[OUTSIDE]] * 2
    assert extraction.diagnostics == ()


def test_what_only_somebody_else_sets_is_told() -> None:
    extraction = scan_text(SPINS.replace('ready.set()', 'pass').replace('done.set()', 'pass'))
    assert [each.slug for each in extraction.diagnostics] == ['nobody-spins'] * 2


BY_A_VARIABLE = """
import signal
import threading
import time
import rclpy

class Tool:
    def __init__(self):
        self.stopped = False
        self.node = rclpy.create_node('tool')
        self.node.create_timer(1.0, lambda: None)
        threading.Thread(target=rclpy.spin, args=(self.node,), daemon=True).start()

    def run(self):
        while not self.stopped:
            time.sleep(1.0)

    def stop(self):
        self.stopped = True

def main():
    tool = None

    def on_signal(number, frame):
        if tool is not None:
            tool.{does}()

    signal.signal(signal.SIGINT, on_signal)
    rclpy.init()
    tool = Tool()
    tool.run()

main()
"""


@pytest.mark.parametrize(('does', 'is_ended'), [('stop', True), ('run', False)])
def test_a_handler_stores_by_what_it_calls(does: str, is_ended: bool) -> None:
    (unit,) = scan_text(BY_A_VARIABLE.format(does=does)).units
    (main,) = (each for each in unit.activities if each.name == 'main')
    wakers = [waker.by for block in main.blocking[-1:] for waker in block.wakers]
    assert (OUTSIDE in wakers) is is_ended


LOOP = """
import asyncio
import signal
import rclpy

async def serve(node):
    stop = asyncio.Event()

    def on_signal():
        stop.set()

    asyncio.get_running_loop().{adds}(signal.SIGINT, on_signal)
    await stop.wait()

rclpy.init()
node = rclpy.create_node('robot')
node.create_timer(0.1, lambda: None)
asyncio.run(serve(node))
rclpy.spin(node)
"""


@pytest.mark.parametrize(('adds', 'is_open'), [('add_signal_handler', False), ('other', True)])
def test_a_loop_has_handlers_of_signals_too(adds: str, is_open: bool) -> None:
    (unit,) = scan_text(LOOP.format(adds=adds)).units
    (block,) = unit.set_up
    assert (block.escapes is not None) is is_open
