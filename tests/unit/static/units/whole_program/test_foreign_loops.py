"""What belongs to a loop of asyncio is touched by another thread than the one that runs it."""

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

class Bridge(Node):
    def __init__(self, loop):
        super().__init__('bridge')
        self.loop = loop
        self.ready = asyncio.Event()
        self.queue = asyncio.Queue()
        self.idle = asyncio.Queue()
        self.answer = loop.create_future()
        self.create_subscription(String, 'text', self.on_text, 10)

    def on_text(self, msg):
        DOES

    async def mark(self):
        self.ready.set()

    async def work(self):
        self.queue.put_nowait(None)
        await self.queue.get()
        await self.ready.wait()
        await self.answer

rclpy.init()
loop = asyncio.new_event_loop()
bridge = Bridge(loop)
"""
BESIDE = """\
threading.Thread(target=loop.run_forever, daemon=True).start()
asyncio.run_coroutine_threadsafe(bridge.work(), loop)
rclpy.spin(bridge)
"""
WITHIN = """\
async def spin():
    while rclpy.ok():
        rclpy.spin_once(bridge, timeout_sec=0)
        await asyncio.sleep(0.01)

loop.run_until_complete(asyncio.gather(spin(), bridge.work()))
"""
POOL = """\
threading.Thread(target=loop.run_forever, daemon=True).start()
asyncio.run_coroutine_threadsafe(bridge.work(), loop)
executor = MultiThreadedExecutor(4)
executor.add_node(bridge)
executor.spin()
"""


def told(does: str, run: str = BESIDE) -> list[str]:
    scan = scan_text(PROGRAM.replace('DOES', does) + run)
    return [d.message.split()[0] for d in scan.diagnostics if d.slug == 'foreign-loop']


@pytest.mark.parametrize(
    ('does', 'how'),
    [
        ('self.queue.put_nowait(msg)', 'put_nowait'),
        ('self.ready.set()', 'set'),
        ('self.answer.set_result(msg)', 'set_result'),
        ('self.loop.call_soon(print)', 'call_soon'),
        ('self.loop.create_task(self.mark())', 'create_task'),
    ],
)
@pytest.mark.parametrize('run', [BESIDE, POOL], ids=['one thread', 'pool'])
def test_what_does_not_wake_the_loop_is_told(does: str, how: str, run: str) -> None:
    assert told(does, run) == [how]


@pytest.mark.parametrize(
    'does',
    [
        'self.loop.call_soon_threadsafe(self.queue.put_nowait, msg)',
        'self.loop.call_soon_threadsafe(lambda: self.ready.set())',
        'asyncio.run_coroutine_threadsafe(self.mark(), self.loop)',
        'self.idle.put_nowait(msg)',
        'None if self.loop.is_running() else self.loop.create_task(self.mark())',
    ],
)
def test_what_is_handed_over_to_the_loop_is_not(does: str) -> None:
    assert told(does) == []


def test_a_loop_that_spins_the_node_runs_its_callbacks_in_its_own_thread() -> None:
    assert told('self.queue.put_nowait(msg)', WITHIN) == []


SERVER = """\
import asyncio
import threading
import rclpy
import websockets
from rclpy.node import Node
from std_msgs.msg import String

class Bridge(Node):
    def __init__(self):
        super().__init__('bridge')
        self.queue = asyncio.Queue()
        self.create_subscription(String, 'text', self.on_text, 10)

    def on_text(self, msg):
        self.queue.put_nowait(msg.data)

    async def serve(self, PARAMETERS):
        while True:
            print(await self.queue.get())

    async def run(self):
        await MADE(self.serve, '127.0.0.1', 8000)
        await asyncio.Event().wait()

rclpy.init()
bridge = Bridge()
threading.Thread(target=rclpy.spin, args=(bridge,), daemon=True).start()
asyncio.run(bridge.run())
"""


@pytest.mark.parametrize(
    ('made', 'parameters', 'waits'),
    [
        ('asyncio.start_server', 'reader, writer', ['asyncio.Queue.get']),
        ('websockets.serve', 'websocket', ['asyncio.Queue.get']),
        ('websockets.serve', 'websocket, path', ['asyncio.Queue.get']),
        ('another.serve', 'websocket', []),
    ],
)
def test_each_connection_is_a_task_of_the_loop(
    made: str, parameters: str, waits: list[str]
) -> None:
    text = SERVER.replace('MADE', made).replace('PARAMETERS', parameters)
    (unit,) = scan_text(text).units
    calls = [block.call for each in unit.activities for block in each.blocking]
    assert [call for call in calls if 'Queue' in call] == waits
