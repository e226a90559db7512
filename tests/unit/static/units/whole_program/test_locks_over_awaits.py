"""Plain locks that a task of an asyncio loop keeps over an ``await``."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import asyncio
import threading
import rclpy
import server
from rclpy.node import Node
from std_msgs.msg import String

class Bridge(Node):
    def __init__(self):
        super().__init__('bridge')
        self.lock = MADE
        self.create_subscription(String, 'text', self.on_text, 10)

    def on_text(self, msg):
        with self.lock:
            self.text = msg

    async def rest(self):
        await asyncio.sleep(0.1)

    async def nothing(self):
        pass

    async def keep(self):
        KEEPS

    async def take(self):
        TAKES

rclpy.init()
bridge = Bridge()
threading.Thread(target=rclpy.spin, args=(bridge,), daemon=True).start()
"""
KEEPS = 'with self.lock: await asyncio.sleep(0.1)'
TAKES = 'with self.lock: pass'
BOTH = """\
async def work():
    await asyncio.gather(bridge.keep(), bridge.take())
asyncio.run(work())
"""


def told(run: str = BOTH, keeps: str = KEEPS, takes: str = TAKES, made: str = 'Lock()') -> list:
    text = PROGRAM.replace('KEEPS', keeps).replace('TAKES', takes)
    text = text.replace('MADE', made if '.' in made else f'threading.{made}')
    found = [d for d in scan_text(text + run).diagnostics if d.slug == 'lock-over-wait']
    return [(d.severity.value, d.place.line) for d in found]


IN_THREAD = 'threading.Thread(target=lambda: asyncio.run(work())).start()'
SURE, MAYBE = [('error', 25)], [('warning', 25)]


@pytest.mark.parametrize(
    'keeps',
    [
        KEEPS,
        'with self.lock: await asyncio.sleep(0)',
        'with self.lock: await self.rest()',
        'with self.lock: await asyncio.to_thread(print)',
        'with self.lock: await server.send("x")',
        'with self.lock: await asyncio.wait_for(server.send("x"), 1.0)',
        'with self.lock: await asyncio.get_running_loop().run_in_executor(None, print)',
        'self.lock.acquire(); await asyncio.sleep(0.1); self.lock.release()',
    ],
)
def test_a_task_that_wants_the_lock_holds_up_the_one_that_has_it(keeps: str) -> None:
    [(severity, line)] = told(keeps=keeps)
    assert severity == 'error'
    assert line in (19, 25)


@pytest.mark.parametrize(
    'keeps',
    [
        'with self.lock:\n            async with server.open(): pass',
        'with self.lock:\n            async for each in server.items(): pass',
    ],
)
def test_so_it_is_in_blocks_and_loops_that_wait(keeps: str) -> None:
    assert told(keeps=keeps) == [('error', 26)]


@pytest.mark.parametrize(
    ('run', 'found'),
    [
        (BOTH, SURE),
        (BOTH.replace('bridge.take()', 'bridge.keep()'), SURE),
        (BOTH.replace('bridge.take()', 'bridge.rest()'), []),
        (BOTH.replace('bridge.take()', '*server.more()'), []),
        (BOTH.replace('bridge.take()', '*[bridge.take() for _ in range(3)]'), SURE),
        (BOTH.replace('bridge.take()', '*(bridge.take() for each in server.ids())'), MAYBE),
        (
            BOTH.replace(
                'bridge.keep(), bridge.take()', '*(bridge.keep() for each in server.ids())'
            ),
            MAYBE,
        ),
        (
            """\
async def work():
    await bridge.keep()
    await bridge.take()
asyncio.run(work())
""",
            [],
        ),
        (
            """\
async def work():
    await asyncio.gather(bridge.keep(), bridge.rest())
    await bridge.take()
asyncio.run(work())
""",
            [],
        ),
        (
            """\
async def work():
    task = asyncio.create_task(bridge.keep())
    await bridge.take()
    await task
asyncio.run(work())
""",
            SURE,
        ),
        (
            """\
async def work():
    task = asyncio.create_task(bridge.keep())
    await task
    await bridge.take()
asyncio.run(work())
""",
            [],
        ),
        (
            """\
async def work():
    async with asyncio.TaskGroup() as tasks:
        tasks.create_task(bridge.keep())
        tasks.create_task(bridge.take())
asyncio.run(work())
""",
            SURE,
        ),
        (
            """\
async def work():
    async with asyncio.TaskGroup() as tasks:
        tasks.create_task(bridge.keep())
    async with asyncio.TaskGroup() as tasks:
        tasks.create_task(bridge.take())
asyncio.run(work())
""",
            [],
        ),
        (
            """\
async def work():
    while rclpy.ok():
        asyncio.create_task(bridge.keep())
        await asyncio.sleep(1.0)
asyncio.run(work())
""",
            MAYBE,
        ),
        (
            """\
async def work():
    while rclpy.ok():
        await asyncio.create_task(bridge.keep())
asyncio.run(work())
""",
            [],
        ),
        ('asyncio.run(bridge.keep())\nasyncio.run(bridge.take())\n', []),
        (
            """\
loop = asyncio.new_event_loop()
loop.run_until_complete(bridge.keep())
loop.run_until_complete(bridge.take())
""",
            [],
        ),
        (
            """\
loop = asyncio.get_event_loop()
loop.create_task(bridge.keep())
loop.create_task(bridge.take())
loop.run_forever()
""",
            SURE,
        ),
        (
            """\
loop = asyncio.new_event_loop()
threading.Thread(target=loop.run_forever, daemon=True).start()
asyncio.run_coroutine_threadsafe(bridge.keep(), loop)
asyncio.run_coroutine_threadsafe(bridge.take(), loop)
""",
            SURE,
        ),
        (
            """\
threading.Thread(target=lambda: asyncio.run(bridge.keep()), daemon=True).start()
asyncio.run(bridge.take())
""",
            [],
        ),
        (
            BOTH.replace(
                'asyncio.run(work())',
                'threading.Thread(target=lambda: asyncio.run(work())).start()',
            ),
            SURE,
        ),
    ],
)
def test_only_what_one_loop_runs_at_once_does(run: str, found: list) -> None:
    assert told(run) == found


@pytest.mark.parametrize(
    ('keeps', 'takes', 'made'),
    [
        (
            f'async {KEEPS}',
            f'async {TAKES}',
            'asyncio.Lock()',
        ),
        (KEEPS, TAKES, 'RLock()'),
        (KEEPS, TAKES, 'Condition()'),
        ('with self.lock: pass', TAKES, 'Lock()'),
        ('with self.lock: pass\n        await asyncio.sleep(0.1)', TAKES, 'Lock()'),
        ('with self.lock: await self.nothing()', TAKES, 'Lock()'),
        (KEEPS, 'if self.lock.acquire(blocking=False): self.lock.release()', 'Lock()'),
        (KEEPS, 'await asyncio.to_thread(self.lock.acquire)', 'Lock()'),
        (KEEPS, 'pass', 'Lock()'),
    ],
)
def test_other_locks_and_what_gives_them_back_in_time_hold_up_nothing(
    keeps: str, takes: str, made: str
) -> None:
    assert told(keeps=keeps, takes=takes, made=made) == []


SPUN = """\
async def spin():
    while rclpy.ok():
        rclpy.spin_once(bridge, timeout_sec=0)
        await asyncio.sleep(0.01)

async def work():
    await asyncio.gather(spin(), bridge.keep())
asyncio.run(work())
"""


def test_a_callback_that_the_loop_spins_holds_it_up_too() -> None:
    begun = 'threading.Thread(target=rclpy.spin, args=(bridge,), daemon=True).start()\n'
    text = PROGRAM.replace(begun, '').replace('KEEPS', KEEPS).replace('TAKES', TAKES)
    text = text.replace('MADE', 'threading.Lock()') + SPUN
    [found] = [d for d in scan_text(text).diagnostics if d.slug == 'lock-over-wait']
    assert 'Bridge.on_text, which is spun in the same asyncio loop, may wait' in found.message


SERVED = """\
app = server.App()

@app.HOW
ASYNC def handle(client):
    KEEP

server.run(app)
"""


@pytest.mark.parametrize(
    ('how', 'keep', 'is_told'),
    [
        ('websocket("/")', 'await bridge.keep()', True),
        ('websocket("/")', 'await bridge.take()', False),
        ('on_event("startup")', 'await bridge.keep()', False),
    ],
)
def test_a_handler_of_a_server_may_run_for_several_clients(
    how: str, keep: str, is_told: bool
) -> None:
    run = SERVED.replace('HOW', how).replace('ASYNC', 'async').replace('KEEP', keep)
    assert bool(told(run)) is is_told


def test_callbacks_of_other_threads_that_wait_as_well_are_named() -> None:
    text = PROGRAM.replace('KEEPS', KEEPS).replace('TAKES', TAKES)
    text = text.replace('MADE', 'threading.Lock()') + BOTH
    [found] = [d for d in scan_text(text).diagnostics if d.slug == 'lock-over-wait']
    assert [each.place.line for each in found.related] == [25, 28, 15]
    assert found.related[-1].text == 'Bridge.on_text waits for it as well, from then on'
