"""One executor that two threads spin, as distinct from one that is spun by one after the other."""

from __future__ import annotations

from textwrap import indent

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor

def serve(node):
    rclpy.spin(node)

def serve_alone(node):
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.spin()

def main():
    rclpy.init()
    one, other = rclpy.create_node('one'), rclpy.create_node('other')
    {rest}
"""
THREAD = 'thread = threading.Thread(target={name}, args=(one,))\nthread.start()\n'
EACH = """\
for node in (one, other):
    threading.Thread(target={name}, args=(node,)).start()
"""


@pytest.mark.parametrize(
    ('rest', 'lines'),
    [
        (THREAD.format(name='serve') + 'serve(other)', [7]),
        (EACH.format(name='serve'), [7]),
        (EACH.format(name='rclpy.spin'), [18]),
        (THREAD.format(name='serve') + 'thread.join()\nserve(other)', []),
        (THREAD.format(name='serve') + 'rclpy.shutdown()\nserve(other)', []),
        ('serve(one)\nserve(other)', []),
        (THREAD.format(name='serve_alone') + 'serve_alone(other)', []),
        (THREAD.format(name='serve_alone') + 'serve(other)', []),
        (EACH.format(name='serve_alone'), []),
    ],
)
def test_one_text_that_two_threads_run_for_two_nodes(rest: str, lines: list[int]) -> None:
    found = scan_text(PROGRAM.format(rest=indent(rest, '    ').lstrip())).diagnostics
    assert [each.place.line for each in found if each.slug == 'executor-spun-twice'] == lines


PROCESSES = """
import multiprocessing
import threading
import rclpy

def serve(name):
    rclpy.init()
    rclpy.spin(rclpy.create_node(name))

def serve_step_by_step(name):
    rclpy.init()
    node = rclpy.create_node(name)
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.2)

def serve_two(name):
    rclpy.init()
    one, other = rclpy.create_node(name), rclpy.create_node('other')
    threading.Thread(target=rclpy.spin, args=(one,)).start()
    rclpy.spin(other)

def main():
    {rest}
"""
APART = """\
one = {each}(target={name}, args=('a',))
other = {each}(target={name}, args=('b',))
one.start()
other.start()
"""
IN_A_LOOP = "for name in 'ab':\n    {each}(target={name}, args=(name,)).start()\n"
LISTED = """\
context = multiprocessing.get_context('spawn')
all_of_them = [context.Process(target={name}, args=(name,)) for name in 'ab']
for each in all_of_them:
    each.start()
"""
PROCESS, OTHER_THREAD = 'multiprocessing.Process', 'threading.Thread'


@pytest.mark.parametrize(
    ('rest', 'lines'),
    [
        (APART.format(each=PROCESS, name='serve'), []),
        (APART.format(each=OTHER_THREAD, name='serve'), [8]),
        (IN_A_LOOP.format(each=PROCESS, name='serve_step_by_step'), []),
        (IN_A_LOOP.format(each=OTHER_THREAD, name='serve_step_by_step'), [14]),
        (LISTED.format(name='serve_step_by_step'), []),
        (LISTED.format(name='serve'), []),
        (IN_A_LOOP.format(each=PROCESS, name='serve') + "serve('c')", []),
        # A process may have two threads as well.
        (f"{PROCESS}(target=serve_two, args=('a',)).start()", [20]),
    ],
)
def test_each_process_has_an_executor_of_its_own(rest: str, lines: list[int]) -> None:
    found = scan_text(PROCESSES.format(rest=indent(rest, '    ').lstrip())).diagnostics
    assert [each.place.line for each in found if each.slug == 'executor-spun-twice'] == lines


IN_CALLBACK = """
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Helper(Node):
    def __init__(self):
        super().__init__('helper')
        self.client = self.create_client(Trigger, 'state')

    def wait_for_others(self):
        while True:
            asked = self.client.call_async(Trigger.Request())
            rclpy.spin_until_future_complete(self, asked)
            if asked.result().success:
                return

class Boss(Node):
    def __init__(self, helper):
        super().__init__('boss')
        self.helper = helper
        self.create_timer(0.5, self.work)

    def work(self):
        self.helper.wait_for_others()

def main():
    rclpy.init()
    helper = Helper()
    {first}
    boss = Boss(helper)
    executor = MultiThreadedExecutor(num_threads=5)
    executor.add_node(boss)
    executor.spin()
"""


@pytest.mark.parametrize(
    ('first', 'lines'),
    [
        ('helper.wait_for_others()', []),
        ('threading.Thread(target=helper.wait_for_others).start()', [16]),
    ],
)
def test_a_spin_of_the_set_up_is_over_when_callbacks_run(first: str, lines: list[int]) -> None:
    found = scan_text(IN_CALLBACK.format(first=first)).diagnostics
    assert [each.place.line for each in found if each.slug == 'executor-spun-twice'] == lines


ASKING = """
import threading
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'state')
        self.create_service(Trigger, 'go', self.go)
        self.asking = threading.Thread(target=self.ask)

    def go(self, request, response):
        {go}
        return response

    def ask(self):
        asked = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, asked)

def main():
    rclpy.init()
    asker = Asker()
    {begin}
    rclpy.spin(asker)
    {end}

main()
"""
STARTED = 'threading.Thread(target=self.ask).start()'


@pytest.mark.parametrize('end', ['pass', 'rclpy.shutdown()'])
@pytest.mark.parametrize(
    ('go', 'begin', 'lines'),
    [
        (STARTED, 'pass', [20]),
        ('pass', 'asker.asking.start()', [20]),
        ('pass', 'asker.asking.start()\n    asker.asking.join()', []),
        ('pass', 'asker.ask()', []),
    ],
)
def test_a_thread_that_spins_for_a_while_beside_main(
    go: str, begin: str, end: str, lines: list[int]
) -> None:
    found = scan_text(ASKING.format(go=go, begin=begin, end=end)).diagnostics
    assert [each.place.line for each in found if each.slug == 'executor-spun-twice'] == lines


SEVERAL = """
import threading
from concurrent.futures import ThreadPoolExecutor
import rclpy
from std_srvs.srv import Trigger

def main():
    rclpy.init()
    node = rclpy.create_node('asker')
    client = node.create_client(Trigger, 'state')
    pool = ThreadPoolExecutor({workers})

    def ask():
        asked = client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(node, asked)

    {does}

main()
"""
LISTED = """threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
{joins}"""
JOINED_LAST = '    for thread in threads:\n        thread.join()'
IN_TURN = """for _ in range(4):
        thread = threading.Thread(target=ask)
        thread.start()
        thread.join()"""
BEGUN = 'threading.Thread(target=ask).start()'
POOLED = 'for _ in range(4):\n        pool.submit(ask)'


@pytest.mark.parametrize(
    ('does', 'workers', 'lines'),
    [
        (LISTED.format(joins=JOINED_LAST), 1, [15]),
        (
            'threading.Thread(target=ask).start()\n    threading.Thread(target=ask).start()',
            1,
            [15],
        ),
        ('threading.Thread(target=ask).start()\n    ask()', 1, [15]),
        (LISTED.format(joins='        thread.join()'), 1, []),
        (IN_TURN, 1, []),
        (POOLED, 4, [15]),
        (POOLED, 1, []),
        ('ask()\n    ask()', 1, []),
    ],
)
def test_several_threads_that_wait_for_answers_of_one_node(
    does: str, workers: int, lines: list[int]
) -> None:
    found = scan_text(SEVERAL.format(does=does, workers=workers)).diagnostics
    assert [each.place.line for each in found if each.slug == 'executor-spun-twice'] == lines


PUMPED = """
import asyncio
import rclpy

async def pump(node):
    while rclpy.ok():
        {step}

rclpy.init()
asyncio.run(pump(rclpy.create_node('pumped')))
"""


@pytest.mark.parametrize(
    ('step', 'lines'),
    [
        ('await asyncio.to_thread(rclpy.spin_until_future_complete, node, rclpy.Future())', []),
        ('asyncio.to_thread(rclpy.spin_until_future_complete, node, rclpy.Future())', [7]),
    ],
)
def test_a_pool_thread_that_is_awaited_each_time(step: str, lines: list[int]) -> None:
    found = scan_text(PUMPED.format(step=step)).diagnostics
    assert [each.place.line for each in found if each.slug == 'executor-spun-twice'] == lines
