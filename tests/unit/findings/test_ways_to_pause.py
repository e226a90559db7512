"""
CC201: ways in which a callback takes two seconds, on the only thread and on one of its own.
"""

from __future__ import annotations

import json
from io import StringIO
from pathlib import Path
from textwrap import indent

import pytest

from ros2cc_extract.cli.main import main

NODE = """\
import asyncio, concurrent.futures, functools, multiprocessing, queue, select, socket
import subprocess, threading, time, urllib.request
from time import monotonic, sleep
import rclpy
from rclpy.duration import Duration
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float32


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        {made}
        own = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Float32, 'go', self.on_go, 10, callback_group=own)
        self.create_timer(0.05, self.control)

    def control(self):
        pass

    def on_go(self, msg):
{body}


rclpy.init()
executor = {executor}
executor.add_node(Arm())
executor.spin()
"""
WAYS = {
    'deadline_or_data': (
        'self.axis = None',
        'end = time.monotonic() + 3.0\n'
        'while time.monotonic() < end:\n'
        '    if self.axis:\n        return\n    time.sleep(0.1)',
    ),
    'ros_clock': (
        'pass',
        'end = self.get_clock().now() + Duration(seconds=2)\n'
        'while rclpy.ok() and self.get_clock().now() < end:\n    time.sleep(0.01)',
    ),
    'ros_clock_since': (
        'pass',
        'begun = self.get_clock().now()\n'
        'while (self.get_clock().now() - begun).nanoseconds / 1e9 < 2.0:\n    pass',
    ),
    'ros_clock_span': (
        'pass',
        'begun = self.get_clock().now()\n'
        'while Duration(seconds=1, nanoseconds=10**9) > self.get_clock().now() - begun:\n    pass',
    ),
    'sleep': ('pass', 'time.sleep(2)'),
    'alias': ('pass', 'sleep(2)'),
    'arith': ('pass', 'time.sleep(1.0 / 10 * 20)'),
    'loop': ('pass', 'for _ in range(20):\n    time.sleep(0.1)'),
    'loop_list': ('pass', 'for x in [1, 2, 3, 4]:\n    time.sleep(0.5)'),
    'loop_attr': ('self.points = [1, 2, 3, 4]', 'for x in self.points:\n    time.sleep(0.5)'),
    'loop_dict': (
        'self.points = {"a": 1, "b": 2, "c": 3}',
        'for k, x in self.points.items():\n    time.sleep(0.5)',
    ),
    'loop_param_n': (
        'self.n = self.declare_parameter("n", 20).value',
        'for _ in range(self.n):\n    time.sleep(0.1)',
    ),
    'loop_msg': ('pass', 'for _ in range(int(msg.data)):\n    time.sleep(0.5)'),
    'comp': ('pass', 'x = [time.sleep(0.1) for _ in range(20)]'),
    'map': ('pass', 'list(map(time.sleep, [0.5, 0.5, 1.0]))'),
    'while_count': ('pass', 'i = 0\nwhile i < 20:\n    time.sleep(0.1)\n    i += 1'),
    'while_deadline': (
        'pass',
        'end = time.time() + 2.0\nwhile time.time() < end:\n    time.sleep(0.1)',
    ),
    'while_mono': (
        'pass',
        'start = monotonic()\nwhile monotonic() - start < 2.0:\n    time.sleep(0.01)',
    ),
    'busy': ('pass', 'end = time.time() + 2.0\nwhile time.time() < end:\n    pass'),
    'partial': ('self.f = functools.partial(time.sleep, 2)', 'self.f()'),
    'lambda_': ('self.f = lambda: time.sleep(2)', 'self.f()'),
    'dict_delay': ('self.cfg = {"settle": 2.0}', 'time.sleep(self.cfg["settle"])'),
    'event': ('pass', 'threading.Event().wait(2)'),
    'event_attr': ('self.e = threading.Event()', 'self.e.wait(timeout=2.0)'),
    'cond': ('self.c = threading.Condition()', 'with self.c:\n    self.c.wait(2.0)'),
    'cond_for': (
        'self.c = threading.Condition()',
        'with self.c:\n    self.c.wait_for(lambda: False, timeout=2.0)',
    ),
    'queue': (
        'self.q = queue.Queue()',
        'try:\n    self.q.get(timeout=2.0)\nexcept queue.Empty:\n    pass',
    ),
    'join': ('pass', 't = threading.Thread(target=time.sleep, args=(2,))\nt.start()\nt.join()'),
    'join_to': (
        'pass',
        't = threading.Thread(target=time.sleep, args=(5,))\nt.start()\nt.join(timeout=2)',
    ),
    'pool': (
        'pass',
        'with concurrent.futures.ThreadPoolExecutor() as p:\n    p.submit(time.sleep, 2)',
    ),
    'pool_result': (
        'self.p = concurrent.futures.ThreadPoolExecutor()',
        'self.p.submit(time.sleep, 2).result()',
    ),
    'pool_result_to': (
        'self.p = concurrent.futures.ThreadPoolExecutor()',
        'f = self.p.submit(time.sleep, 9)\ntry:\n'
        '    f.result(timeout=2)\nexcept Exception:\n    pass',
    ),
    'sub_to': ('pass', 'subprocess.run(["scan"], timeout=2)'),
    'select': ('pass', 'select.select([0], [], [], 2.0)'),
    'sock': ('self.s = socket.socket()\nself.s.settimeout(2.0)', 'self.s.recv(10)'),
    'sock_conn': ('pass', 'socket.create_connection(("robot", 80), timeout=2)'),
    'url': ('pass', 'urllib.request.urlopen("http://robot", timeout=2)'),
    'lock_to': ('self.l = threading.Lock()\nself.l.acquire()', 'self.l.acquire(timeout=2.0)'),
    'finally_': ('pass', 'try:\n    pass\nfinally:\n    time.sleep(2)'),
    'cond_branch': ('pass', 'if msg.data > 0:\n    time.sleep(2)'),
    'two': ('pass', 'time.sleep(0.6)\nself.control()\ntime.sleep(0.6)'),
    'barrier': ('self.b = threading.Barrier(2)', 'self.b.wait(2.0)'),
    'sem': ('self.b = threading.Semaphore(0)', 'self.b.acquire(timeout=2.0)'),
    'usleep': ('pass', 'time.sleep(2000 * 1e-3)'),
    'proc_wait': (
        'pass',
        'p = subprocess.Popen(["scan"])\ntry:\n'
        '    p.wait(timeout=2)\nexcept Exception:\n    p.kill()',
    ),
    'mp': (
        'pass',
        'import multiprocessing\np = multiprocessing.Process(target=time.sleep, args=(2,))\n'
        'p.start()\np.join()',
    ),
}
"""What is made, and what the callback does."""
ONE, MANY = 'SingleThreadedExecutor()', 'MultiThreadedExecutor(num_threads=3)'


def told(folder: Path, made: str, body: str, executor: str) -> list[tuple[str, str]]:
    path, out = folder / 'arm.py', StringIO()
    made, body = indent(made, ' ' * 8).strip(), indent(body, ' ' * 8)
    path.write_text(NODE.format(made=made, body=body, executor=executor))
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    found = json.loads(out.getvalue())['findings']
    return [(f['code'], f['severity']) for f in found if f['code'].startswith('CC2')]


@pytest.mark.parametrize('way', WAYS)
def test_what_holds_up_a_fast_timer_is_told(tmp_path: Path, way: str) -> None:
    assert told(tmp_path, *WAYS[way], ONE) == [('CC201', 'warning')]


@pytest.mark.parametrize('way', WAYS)
def test_with_a_thread_and_a_group_of_its_own_it_is_not(tmp_path: Path, way: str) -> None:
    assert told(tmp_path, *WAYS[way], MANY) == []


@pytest.mark.parametrize('seconds', ['msg.data', 'max(1.0, msg.data)'])
def test_a_sleep_of_unknown_length_leaves_it_open(tmp_path: Path, seconds: str) -> None:
    assert told(tmp_path, 'pass', f'time.sleep({seconds})', ONE) == []
    out = StringIO()
    main(['check', '--no-cache', str(tmp_path / 'arm.py')], out, StringIO())
    assert '? no starvation: how long Arm.on_go sleeps at ' in out.getvalue()


@pytest.mark.parametrize(
    'body',
    [
        'i = 0\nwhile i < 1e400:\n    time.sleep(0.1)\n    i += 1',
        'i = 0\nwhile i < 5:\n    time.sleep(0.1)\n    i += 1e-320',
        'end = time.time() + 1e400\nwhile time.time() < end:\n    time.sleep(1e-300)',
        'end = time.time() + 10**400\nwhile time.time() < end:\n    pass',
        't = time.time()\nwhile (time.time() - t) / 1e-320 < 3:\n    pass',
        't = time.time()\nwhile (time.time() - t) / 0 < 3:\n    pass',
        'b, most = self.get_clock().now(), Duration(seconds=10**400, nanoseconds=1e400)\n'
        'while self.get_clock().now() - b < most:\n    pass',
    ],
)
def test_numbers_with_which_nobody_counts_say_nothing(tmp_path: Path, body: str) -> None:
    assert told(tmp_path, 'pass', body, ONE) == []


ROUNDS = """\
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Benchmark(Node):
    def __init__(self):
        super().__init__('benchmark')
        self.least = self.get_parameter('least').value
        self.create_subscription(String, 'image', self.on_image, 10)
        self.create_timer(500.0, self.start)

    def on_image(self, msg):
        self.get_logger().info(msg.data)

    def start(self):
        for width in [320, 480, 640, 800]:
            self.run(width)

    def run(self, width):
        begun = self.begun = time.time()
{body}


rclpy.init()
rclpy.spin(Benchmark())
"""
BY_TIME = 'while time.time() - begun < 60.0:\n    '
OPEN = 'while self.get_parameter("on").value:\n    '


@pytest.mark.parametrize(
    ('body', 'words'),
    [
        ('time.sleep(1.5)', 'sleeps 1.5 s 4 times (6 s in all) and'),
        (BY_TIME + 'time.sleep(1.5)', 'sleeps 1.5 s 160 times (240 s in all) and'),
        (BY_TIME + 'pass', 'asks a clock in a loop for 60 s 4 times (240 s in all) and'),
        (
            'for k in (1, 2):\n    i = 0\n'
            '    while i < 5:\n        i += 1\n        time.sleep(0.5)',
            'sleeps 0.5 s 40 times (20 s in all) and',
        ),
        (OPEN + 'time.sleep(1.5)', 'sleeps 1.5 s 4 times or more (at least 6 s in all) and'),
        (OPEN + 'if width > self.least:\n        time.sleep(1.5)', 'sleeps 1.5 s again and again'),
        (
            'while time.time() - self.begun < 60.0:\n'
            '    if self.get_clock().now().nanoseconds % 2:\n        time.sleep(1.5)',
            'sleeps 1.5 s again and again and',
        ),
    ],
)
def test_a_loop_in_each_round_of_another(body: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / 'benchmark.py'
    path.write_text(ROUNDS.format(body=indent(body, ' ' * 8)), encoding='utf-8')
    out = StringIO()
    main(['check', '--no-cache', '--output-format', 'json', str(path)], out, StringIO())
    told = [f['message'] for f in json.loads(out.getvalue())['findings'] if f['code'] == 'CC201']
    assert [each.startswith(f'Benchmark.start {words}') for each in told] == [True], told
