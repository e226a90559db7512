"""
CC301: ways in which a thread of the program, or another executor, changes what a callback changes.
"""

from __future__ import annotations

from textwrap import indent

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """\
import asyncio, concurrent.futures, contextlib, functools, http.server, multiprocessing.dummy
import queue, socketserver, threading, time, _thread
import rclpy
import rclpy.executors
from rclpy.node import Node
from std_msgs.msg import String

{before}

class Store(Node{base}):
    def __init__(self):
        super().__init__('store')
        self.n = 0
        self.lock = threading.Lock()
        self.create_subscription(String, 'a', self.on_a, 10)
{init}

    def on_a(self, msg):
        self.change(2)

    def change(self, k):
{change}

    def loop(self, *args):
        while True:
            self.change(1)

    def once(self, *args):
        self.change(1)

{more}


rclpy.init()
node = Store()
{run}
"""
CHANGE = 'x = self.n\ntime.sleep(0.01)\nself.n = x + k'
SPIN = 'rclpy.spin(node)'

WAYS: dict[str, dict[str, str]] = {
    'thread': {
        'init': 'threading.Thread(target=self.loop).start()',
    },
    'thread_daemon': {
        'init': ('self.t = threading.Thread(target=self.loop, daemon=True)\nself.t.start()\n'),
    },
    'thread_pos': {
        'init': 't = threading.Thread(None, self.loop)\nt.start()',
    },
    'partial': {
        'init': 'threading.Thread(target=functools.partial(self.loop, 1)).start()',
    },
    'lambda_': {
        'init': 'threading.Thread(target=lambda: self.loop()).start()',
    },
    'closure': {
        'init': 'def go():\n    self.loop()\nthreading.Thread(target=go).start()',
    },
    'args': {
        'init': 'threading.Thread(target=Store.loop, args=(self,)).start()',
    },
    'cls': {
        'init': 'threading.Thread(target=self.__class__.loop, args=(self,)).start()',
    },
    'kwargs': {
        'init': 'threading.Thread(**dict(target=self.loop)).start()',
    },
    'subclass': {
        'init': 'Worker(self).start()',
        'before': (
            'class Worker(threading.Thread):\n'
            '    def __init__(self, node):\n'
            '        super().__init__()\n'
            '        self.node = node\n'
            '    def run(self):\n'
            '        self.node.loop()\n'
        ),
    },
    'subclass_node': {
        'init': 'threading.Thread.__init__(self)\nself.start()',
        'base': ', threading.Thread',
        'more': 'def run(self):\n    self.loop()',
    },
    'list_': {
        'init': (
            'self.ts = [threading.Thread(target=f) for f in (self.loop,)]\n'
            'for t in self.ts:\n'
            '    t.start()\n'
        ),
    },
    'map_start': {
        'init': (
            'self.ts = [threading.Thread(target=self.loop)]\n'
            'list(map(threading.Thread.start, self.ts))\n'
        ),
    },
    'timer': {
        'init': 'threading.Timer(0.5, self.once).start()',
    },
    'pool_submit': {
        'init': ('self.p = concurrent.futures.ThreadPoolExecutor()\nself.p.submit(self.loop)\n'),
    },
    'pool_map': {
        'init': (
            'self.p = concurrent.futures.ThreadPoolExecutor()\nself.p.map(self.once, range(3))\n'
        ),
    },
    'pool_with': {
        'init': ('with concurrent.futures.ThreadPoolExecutor() as p:\n    p.submit(self.once)\n'),
    },
    'low': {
        'init': '_thread.start_new_thread(self.loop, ())',
    },
    'to_thread': {
        'run': (
            'threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n'
            'async def m():\n'
            '    await asyncio.to_thread(node.loop)\n'
            'asyncio.run(m())\n'
        ),
    },
    'run_in_exec': {
        'run': (
            'threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n'
            'async def m():\n'
            '    await asyncio.get_running_loop().run_in_executor(None, node.loop)\n'
            'asyncio.run(m())\n'
        ),
    },
    'threadsafe': {
        'init': (
            'self.l = asyncio.new_event_loop()\n'
            'threading.Thread(target=self.l.run_forever, daemon=True).start()\n'
            'asyncio.run_coroutine_threadsafe(self.co(), self.l)\n'
        ),
        'more': (
            'async def co(self):\n'
            '    while True:\n'
            '        self.change(1)\n'
            '        await asyncio.sleep(0.1)\n'
        ),
    },
    'call_soon': {
        'init': (
            'self.l = asyncio.new_event_loop()\n'
            'threading.Thread(target=self.l.run_forever, daemon=True).start()\n'
            'self.l.call_soon_threadsafe(self.change, 1)\n'
        ),
    },
    'task_of_loop': {
        'init': (
            'self.l = asyncio.new_event_loop()\n'
            'threading.Thread(target=self.l.run_forever, daemon=True).start()\n'
            'self.l.call_soon_threadsafe(lambda: self.l.create_task(self.co()))\n'
        ),
        'more': 'async def co(self):\n    self.change(1)',
    },
    'initializer': {
        'init': (
            'self.p = concurrent.futures.ThreadPoolExecutor(initializer=self.once)\n'
            'self.p.submit(print, 1)\n'
        ),
    },
    'main_beside': {
        'run': (
            'threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\nnode.loop()\n'
        ),
    },
    'main_while': {
        'run': (
            'threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n'
            'while rclpy.ok():\n'
            '    node.change(1)\n'
        ),
    },
    'deco': {
        'init': 'self.bg()',
        'before': (
            'def threaded(f):\n'
            '    @functools.wraps(f)\n'
            '    def g(*a, **k):\n'
            '        t = threading.Thread(target=f, args=a, kwargs=k, daemon=True)\n'
            '        t.start()\n'
            '        return t\n'
            '    return g\n'
        ),
        'more': '@threaded\ndef bg(self):\n    self.loop()',
    },
    'in_cb': {
        'init': 'self.create_timer(10.0, self.begin)',
        'more': 'def begin(self):\n    threading.Thread(target=self.loop).start()',
    },
    'lazy_prop': {
        'init': 'self.create_timer(10.0, self.begin)',
        'more': (
            '@functools.cached_property\n'
            'def worker(self):\n'
            '    t = threading.Thread(target=self.loop)\n'
            '    t.start()\n'
            '    return t\n'
            'def begin(self):\n'
            '    self.worker\n'
        ),
    },
    'queue_worker': {
        'init': (
            'self.q = queue.Queue()\nthreading.Thread(target=self.serve).start()\nself.q.put(1)\n'
        ),
        'more': (
            'def serve(self):\n    while True:\n        k = self.q.get()\n        self.change(k)\n'
        ),
    },
    'ctx': {
        'init': 'self.w = Bg(self.loop)\nself.w.__enter__()',
        'before': (
            'class Bg:\n'
            '    def __init__(self, f):\n'
            '        self.f = f\n'
            '    def __enter__(self):\n'
            '        threading.Thread(target=self.f).start()\n'
            '        return self\n'
            '    def __exit__(self, *a):\n'
            '        pass\n'
        ),
    },
    'socketserver': {
        'init': (
            'self.s = socketserver.ThreadingTCPServer(("", 9000), Handler)\n'
            'self.s.node = self\n'
            'threading.Thread(target=self.s.serve_forever).start()\n'
        ),
        'before': (
            'class Handler(socketserver.BaseRequestHandler):\n'
            '    def handle(self):\n'
            '        self.server.node.change(1)\n'
        ),
    },
    'http': {
        'init': (
            'Handler.node = self\n'
            'self.s = http.server.ThreadingHTTPServer(("", 8000), Handler)\n'
            'threading.Thread(target=self.s.serve_forever).start()\n'
        ),
        'before': (
            'class Handler(http.server.BaseHTTPRequestHandler):\n'
            '    node = None\n'
            '    def do_GET(self):\n'
            '        self.node.change(1)\n'
        ),
    },
    'http_partial': {
        'init': (
            'handler = functools.partial(Handler, self)\n'
            'self.s = http.server.HTTPServer(("", 8000), handler)\n'
            'threading.Thread(target=self.s.serve_forever).start()\n'
        ),
        'before': (
            'class Handler(http.server.BaseHTTPRequestHandler):\n'
            '    def __init__(self, node, *args):\n'
            '        self.node = node\n'
            '        super().__init__(*args)\n'
            '    def do_GET(self):\n'
            '        self.node.change(1)\n'
        ),
    },
    'mp_dummy': {
        'init': 'multiprocessing.dummy.Process(target=self.loop).start()',
    },
    'second_exec': {
        'before': 'import rclpy.executors',
        'run': (
            'other = rclpy.create_node("other")\n'
            'other.create_timer(0.1, node.once)\n'
            'ex = rclpy.executors.SingleThreadedExecutor()\n'
            'ex.add_node(other)\n'
            'threading.Thread(target=ex.spin, daemon=True).start()\n'
            'rclpy.spin(node)\n'
        ),
    },
}


def told(way: str, change: str) -> set[Severity | None]:
    given = {'init': 'pass', 'before': '', 'base': '', 'more': '', 'run': SPIN, **WAYS[way]}
    text = NODE.format(
        before=given['before'],
        base=given['base'],
        init=indent(given['init'], ' ' * 8),
        change=indent(change, ' ' * 8),
        more=indent(given['more'], ' ' * 4),
        run=given['run'],
    )
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    return {each.severity for each in found if each.code.startswith('CC3')}


@pytest.mark.parametrize('way', WAYS)
def test_what_a_thread_changes_beside_a_callback_is_told(way: str) -> None:
    assert told(way, CHANGE) == {Severity.WARNING}


@pytest.mark.parametrize('way', WAYS)
def test_the_same_under_one_lock_is_not(way: str) -> None:
    assert told(way, f'with self.lock:\n{indent(CHANGE, " " * 4)}') == set()
