"""
A condition forgets a notify that comes while nobody waits: when a wait may miss it, and when not.

Each program was run on rclpy 7.1.6: those that must be heard went on, the others hung.
"""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import Blocking

PROGRAM = """\
import threading
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        free = ReentrantCallbackGroup()
        self.lock = threading.Lock()
        self.cond = threading.Condition()
        self.with_lock = threading.Condition(self.lock)
        self.arrived = threading.Event()
        self.ready, self.is_on = False, True
        self.state = state_of_plant()
        self.client = self.create_client(Trigger, 'go', callback_group=free)
        self.once = self.create_timer(0.2, self.tell, callback_group=free)
        self.create_timer(1.0, self.work, callback_group=free)

    def is_ready(self):
        return self.ready

    def work(self):
{work}

    def tell(self):
{tell}
{more}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Arm())
executor.spin()
"""
TELLS = """
self.once.cancel()
with self.cond:
    self.ready = True
    self.arrived.set()
    self.cond.notify()
"""
AGAIN = TELLS.replace('self.once.cancel()', 'pass')
WAITS = """
with self.cond:
    self.cond.wait()
"""


ANSWER = """
    def answer(self, future=None):
        with self.cond:
            self.cond.notify()
"""


def wait_of(work: str, tell: str = TELLS, more: str = '') -> Blocking:
    def indented(text: str) -> str:
        return '\n'.join(f'        {line}' for line in text.strip().splitlines())

    program = PROGRAM.replace('{work}', indented(work)).replace('{tell}', indented(tell))
    program = program.replace('{more}', more)
    (unit,) = scan_text(program).units
    worker = next(c for c in unit.callbacks if c.function and c.function.endswith('work'))
    return next(b for b in worker.blocking if b.call.startswith('Condition.'))


def asking(test: str, loop: str = 'while') -> str:
    return f'with self.cond:\n    {loop} {test}:\n        self.cond.wait()'


@pytest.mark.parametrize(
    'work',
    [
        asking('not self.ready', 'if'),
        asking('not self.ready'),
        asking('not self.is_ready()'),
        asking('not self.arrived.is_set()', 'if'),
        asking('not self.state.ready', 'if'),
        'with self.cond:\n    ready = self.ready\n    if not ready:\n        self.cond.wait()',
        'with self.cond:\n    if self.ready:\n        return\n    self.cond.wait()',
        'with self.cond:\n    while True:\n        if self.ready:\n            break\n'
        '        self.cond.wait()',
        'with self.cond:\n    self.cond.wait_for(lambda: self.ready)',
    ],
)
def test_who_asks_under_the_lock_misses_nothing(work: str) -> None:
    wait = wait_of(work)
    assert (wait.forgets, wait.escapes) == (False, None)


@pytest.mark.parametrize(
    'work',
    [
        WAITS,
        'if not self.ready:\n    with self.cond:\n        self.cond.wait()',
        'if self.ready:\n    return\nwith self.cond:\n    self.cond.wait()',
        asking('self.is_on', 'if'),
        'while not self.ready:\n    with self.cond:\n        self.cond.wait()',
    ],
)
@pytest.mark.parametrize('tell', [TELLS, AGAIN])
def test_who_does_not_ask_or_asks_before_may_miss_it(work: str, tell: str) -> None:
    wait = wait_of(work, tell)
    assert (wait.forgets, wait.escapes) == (True, None)


def test_what_is_asked_for_must_be_written_by_then_or_in_the_same_hold() -> None:
    late = 'self.once.cancel()\nwith self.cond:\n    self.cond.notify()\nself.ready = True'
    early = 'self.once.cancel()\nself.ready = True\nwith self.cond:\n    self.cond.notify()'
    for work in (
        asking('not self.ready'),
        'with self.cond:\n    self.cond.wait_for(self.is_ready)',
    ):
        assert wait_of(work, late).forgets
        assert not wait_of(work, early).forgets


def test_a_condition_over_a_lock_is_that_lock() -> None:
    work = 'with self.lock:\n    while not self.ready:\n        self.with_lock.wait()'
    tell = TELLS.replace('with self.cond', 'with self.lock').replace('self.cond', 'self.with_lock')
    wait = wait_of(work, tell)
    assert (wait.forgets, wait.held) == (False, ())


@pytest.mark.parametrize(
    'begun',
    [
        'threading.Thread(target=self.answer, daemon=True).start()',
        'self.client.call_async(Trigger.Request()).add_done_callback(self.answer)',
    ],
)
def test_what_is_begun_under_the_lock_comes_after_the_wait(begun: str) -> None:
    inside = WAITS.replace('    self', f'    {begun}\n    self')
    is_lost, is_heard = (wait_of(work, 'pass', ANSWER) for work in (begun + WAITS, inside))
    assert is_lost.forgets or is_lost.escapes is not None
    assert (is_heard.forgets, is_heard.escapes) == (False, None)


def test_a_notifier_that_goes_round_comes_again() -> None:
    wait = wait_of(WAITS, 'while rclpy.ok():\n    with self.cond:\n        self.cond.notify()')
    assert not wait.forgets


def test_what_is_told_once_and_taken_back_is_not_decided() -> None:
    work = asking('not self.ready') + '\n    self.ready = False'
    wait = wait_of(work)
    assert wait.escapes is not None
    assert wait.escapes.reason == (
        'tell, which ends it, runs once only, and perhaps its signal is undone'
    )


WORKER = """\
import collections
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Worker(Node):
    def __init__(self):
        super().__init__('worker')
        self.jobs = collections.deque()
        self.lock = threading.RLock()
        self.more = threading.Condition(self.lock)
        self.create_subscription(String, 'jobs', self.on_job, 10)
        threading.Thread(target=self.run, daemon=True).start()

    def on_job(self, msg):
        with self.lock:
            self.jobs.append(msg)
            self.more.notify()

    def run(self):
        while rclpy.ok():
            with self.lock:
                while not self.jobs:
                    self.more.wait()
                self.jobs.popleft()


rclpy.init()
rclpy.spin(Worker())
"""


def test_a_thread_that_asks_in_a_loop_waits_for_the_condition_and_holds_nothing() -> None:
    (unit,) = scan_text(WORKER).units
    (thread,) = unit.activities
    (wait,) = thread.blocking
    assert (wait.call, wait.held, wait.forgets, wait.escapes) == (
        'Condition.wait',
        (),
        False,
        None,
    )
    assert [waker.by for waker in wait.wakers] == ['on_job']
