"""
The forms in which a node of asyncio is written and run: none of them is a finding.

They are those of the documentation of rclpy 10.0.10 (``AsyncNode``, ``run``), and of programs that
go on until somebody ends them.
"""

from __future__ import annotations

import re
import textwrap
from io import StringIO
from pathlib import Path

import pytest

from ros2cc_extract.cli.main import main

HEAD = """\
import asyncio
import signal
import urllib.request

import rclpy
from rclpy.experimental import AsyncNode
from std_msgs.msg import String
from std_srvs.srv import Trigger
"""
FORMS = {
    'a class that is run': """
        class Server(AsyncNode):
            def __init__(self):
                super().__init__('server')
                self._nap = self.create_service(Trigger, 'nap', self.nap)
                self._page = self.create_service(Trigger, 'page', self.page, concurrent=True)
                self._client = self.create_client(Trigger, 'elsewhere')

            async def nap(self, request, response):
                self.get_logger().info('nap')
                await self.get_clock().sleep(2.0)
                await self._client.wait_for_service()
                answer = await self._client.call(request)
                response.success = answer.success
                return response

            def read(self):
                with urllib.request.urlopen('https://example.org', timeout=5.0) as page:
                    return page.read()

            async def page(self, request, response):
                response.message = str(await asyncio.to_thread(self.read))
                return response

        async def start():
            with rclpy.init():
                node = Server()
                await node.run()

        def main():
            asyncio.run(start())

        if __name__ == '__main__':
            main()
    """,
    'a client in a block': """
        async def start():
            with rclpy.init():
                async with AsyncNode('asker') as node:
                    client = node.create_client(Trigger, 'nap')
                    await client.wait_for_service()
                    print((await client.call(Trigger.Request())).success)

        asyncio.run(start())
    """,
    'entities of a block': """
        async def work():
            await asyncio.sleep(5.0)

        async def start():
            with rclpy.init():
                async with AsyncNode('listener') as node:
                    node.create_subscription(String, 'text', lambda msg: print(msg), 10)
                    await work()

        asyncio.run(start())
    """,
    'two nodes and a loop in a group of tasks': """
        async def talk(node, publisher):
            while True:
                publisher.publish(String(data='text'))
                await node.get_clock().sleep(0.5)

        async def start():
            with rclpy.init():
                a, b = AsyncNode('a'), AsyncNode('b')
                publisher = a.create_publisher(String, 'text', 10)
                b.create_subscription(String, 'text', lambda msg: print(msg), 10)
                async with asyncio.TaskGroup() as tasks:
                    tasks.create_task(a.run())
                    tasks.create_task(b.run())
                    tasks.create_task(talk(a, publisher))

        asyncio.run(start())
    """,
    'a node beside a coroutine': """
        class Talker(AsyncNode):
            def __init__(self):
                super().__init__('talker')
                self.ready = asyncio.Event()
                self.create_subscription(String, 'text', self.on_text, 10)

            def on_text(self, msg):
                self.ready.set()

            async def work(self):
                await self.ready.wait()

        async def start():
            with rclpy.init():
                node = Talker()
                await asyncio.gather(node.run(), node.work())

        asyncio.run(start())
    """,
}
FOR_EVER = """
    async def start():
        rclpy.init()
        async with AsyncNode('a') as node:
            node.create_timer(0.1, lambda: print('tick'))
            {}

    asyncio.run(start())
"""
UNTIL_ENDED = (
    'await asyncio.Event().wait()',
    'await asyncio.Future()',
    'await asyncio.sleep(float("inf"))',
    'stop = asyncio.Event(); '
    'asyncio.get_running_loop().add_signal_handler(signal.SIGINT, stop.set); await stop.wait()',
)
TEXTS = FORMS | {form: FOR_EVER.format(form) for form in UNTIL_ENDED}


def checked(text: str, folder: Path) -> str:
    path = folder / 'node.py'
    path.write_text(HEAD + textwrap.dedent(text))
    out = StringIO()
    main([str(path)], out, StringIO())
    return out.getvalue()


@pytest.mark.parametrize('form', TEXTS)
def test_a_form_is_no_finding(form: str, tmp_path: Path) -> None:
    shown = checked(TEXTS[form], tmp_path)
    assert re.findall(r': (?:error|warning) CC\d+', shown) == []
    assert 'AsyncNode, 1 thread' in shown
    assert '✗' not in shown


def test_a_block_in_which_the_loop_is_blocked_is_one(tmp_path: Path) -> None:
    text = FOR_EVER.format(
        'asyncio.run_coroutine_threadsafe(asyncio.sleep(1), asyncio.get_running_loop()).result()'
    )
    assert 'error CC102' in checked(text, tmp_path)
