"""A callback needs a loop of asyncio in its thread, and none runs there."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import asyncio
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Uploader(Node):
    def __init__(self):
        super().__init__('uploader')
        self.loop = asyncio.new_event_loop()
        self.create_subscription(String, 'text', self.on_text, 10)

    DEF on_text(self, msg):
        DOES

    async def upload(self):
        asyncio.create_task(asyncio.sleep(1.0))
        await asyncio.sleep(1.0)

    def start(self):
        asyncio.create_task(self.upload())

rclpy.init()
node = Uploader()
"""
MAIN = 'rclpy.spin(node)\n'
THREAD = """\
spinning = threading.Thread(target=rclpy.spin, args=(node,))
spinning.start()
spinning.join()
"""
POOL = """\
executor = MultiThreadedExecutor(4)
executor.add_node(node)
executor.spin()
"""
WITHIN = """\
async def spin():
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0)
        await asyncio.sleep(0.01)

asyncio.run(spin())
"""
POOL_WITHIN = """\
executor = MultiThreadedExecutor(4)
executor.add_node(node)
async def spin():
    while rclpy.ok():
        executor.spin_once(timeout_sec=0)
        await asyncio.sleep(0.01)

asyncio.run(spin())
"""
THREAD_BESIDE_LOOP = """\
async def work():
    spinning = threading.Thread(target=rclpy.spin, args=(node,))
    spinning.start()
    while rclpy.ok():
        await asyncio.sleep(0.01)

asyncio.run(work())
"""
POOL_OF_LOOP = """\
async def work():
    await asyncio.get_running_loop().run_in_executor(None, rclpy.spin, node)

asyncio.run(work())
"""
LOOP_IN_THREAD = """\
async def spin():
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0)
        await asyncio.sleep(0.01)

threading.Thread(target=lambda: asyncio.run(spin())).start()
"""
OF_LOOP = """\
async def spin():
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0)
        await asyncio.sleep(0.01)

loop = asyncio.new_event_loop()
threading.Thread(target=loop.run_forever).start()
asyncio.run_coroutine_threadsafe(spin(), loop)
"""
TASK = 'asyncio.create_task(self.upload())'


def told(does: str, run: str = MAIN, define: str = 'def') -> list[tuple[str, str]]:
    scan = scan_text(PROGRAM.replace('DOES', does).replace('DEF', define) + run)
    slugs = ('no-running-loop', 'lost-task')
    return [(d.slug, d.message.split()[0]) for d in scan.diagnostics if d.slug in slugs]


@pytest.mark.parametrize(
    'run', [MAIN, THREAD, POOL, POOL_WITHIN, THREAD_BESIDE_LOOP, POOL_OF_LOOP]
)
@pytest.mark.parametrize('define', ['def', 'async def'])
def test_a_task_needs_a_loop_that_runs_in_its_thread(run: str, define: str) -> None:
    assert told(TASK, run, define) == [('no-running-loop', 'asyncio.create_task')]


@pytest.mark.parametrize('run', [WITHIN, LOOP_IN_THREAD, OF_LOOP])
def test_a_coroutine_that_spins_runs_the_callbacks_in_its_loop(run: str) -> None:
    assert told(TASK, run) == []


@pytest.mark.parametrize(
    'does',
    [
        'asyncio.get_running_loop().create_task(self.upload())',
        'asyncio.current_task()',
        'self.start()',
    ],
)
def test_so_does_what_asks_for_the_loop_or_task(does: str) -> None:
    assert [slug for slug, _ in told(does)] == ['no-running-loop']


@pytest.mark.parametrize(
    'does',
    ['asyncio.ensure_future(self.upload())', 'asyncio.get_event_loop().create_task(None)'],
)
def test_only_the_main_thread_has_a_loop_that_does_not_run(does: str) -> None:
    assert [slug for slug, _ in told(does, THREAD)] == ['no-running-loop']
    assert [slug for slug, _ in told(does, POOL)] == ['no-running-loop']
    assert 'no-running-loop' not in [slug for slug, _ in told(does, MAIN)]


def test_nothing_runs_what_is_left_to_the_loop_of_the_main_thread() -> None:
    does = 'asyncio.ensure_future(self.upload())'
    assert told(does) == [('lost-task', 'asyncio.ensure_future')]
    assert told(does, WITHIN) == []


@pytest.mark.parametrize(
    'does',
    [
        'asyncio.run(self.upload())',
        'asyncio.run_coroutine_threadsafe(self.upload(), self.loop)',
        'self.loop.call_soon_threadsafe(self.start)',
        'threading.Thread(target=lambda: asyncio.run(self.upload())).start()',
        f'try: {TASK}\n        except RuntimeError: asyncio.run(self.upload())',
        f'try: {TASK}\n        except Exception: pass',
        f'if self.loop.is_running(): {TASK}',
    ],
)
def test_what_brings_a_loop_or_catches_that_there_is_none_is_not_told(does: str) -> None:
    assert told(does) == []


def test_another_error_that_is_caught_helps_nothing() -> None:
    does = f'try: {TASK}\n        except ValueError: pass'
    assert told(does) == [('no-running-loop', 'asyncio.create_task')]
