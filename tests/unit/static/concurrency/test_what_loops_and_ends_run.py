"""
What runs though no line of the program calls it, and what a thread that ends leaves undone.

An object's ``__next__`` in a loop, functions of ``atexit``; a thread whose loop an error ends.
"""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import TIME, Blocking

HEAD = """\
import atexit
import queue
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
"""

PACED = (
    HEAD
    + """
class Pacer:
    def __init__(self, node):
        self.rate = node.create_rate(10.0)

    def __iter__(self):
        return self

    def __next__(self):
        self.rate.sleep()
        return 1

class Walker(Node):
    def __init__(self):
        super().__init__('walker')
        self.pacer = Pacer(self)
        self.create_subscription(String, 'walk', self.walk, 10)

    def walk(self, msg):
        for _ in self.pacer:
            self.get_logger().info(msg.data)

rclpy.init()
rclpy.spin(Walker())
"""
)

ARCHIVE = (
    HEAD
    + """
class Archive(Node):
    def __init__(self):
        super().__init__('archive')
        self.jobs = queue.Queue()
        self.create_subscription(String, 'lines', self.take, 10)
        self.create_timer(1.0, self.flush)
        threading.Thread(target=self.work, daemon=True).start()

    def take(self, msg):
        self.jobs.put(msg.data)

    def flush(self):
        self.jobs.join()

    def work(self):
        while True:
            line = self.jobs.get()
            TESTS
            self.jobs.task_done()

rclpy.init()
rclpy.spin(Archive())
"""
)

UPLOAD = (
    HEAD
    + """
class Upload(Node):
    def __init__(self):
        super().__init__('upload')
        self.new = threading.Event()
        self.over = False
        self.thread = threading.Thread(target=self.work, daemon=True)
        self.thread.start()
        self.create_subscription(String, 'lines', self.take, 10)
        REGISTERS

    def take(self, msg):
        self.new.set()

    def work(self):
        while not self.over:
            self.new.wait()
            self.new.clear()

    def close(self, wakes=False):
        self.over = True
        if wakes:
            self.new.set()
        self.thread.join()

rclpy.init()
rclpy.spin(Upload())
"""
)


def waits(text: str, name: str) -> tuple[Blocking, ...]:
    (unit,) = scan_text(text).units
    return next(each.blocking for each in unit.callbacks if each.name == name)


def slugs(text: str) -> list[str]:
    return [each.slug for each in scan_text(text).diagnostics]


def test_a_loop_over_an_object_waits_in_what_gives_the_next_item() -> None:
    (sleep,) = waits(PACED, 'walk')
    assert sleep.call == 'Rate.sleep'
    assert sleep.source is not None
    assert sleep.source.line == PACED[: PACED.index('self.rate.sleep')].count('\n') + 1


def test_who_joins_a_queue_goes_on_where_a_thread_does_all_that_is_in_it() -> None:
    (join,) = waits(ARCHIVE.replace('TESTS', ''), 'flush')
    assert [waker.by for waker in join.wakers] == [TIME]
    assert join.escapes is None


def test_who_joins_a_queue_may_wait_for_a_thread_that_an_error_has_ended() -> None:
    text = ARCHIVE.replace('TESTS', 'if not line: raise ValueError(line)')
    (join,) = waits(text, 'flush')
    assert [(waker.by, waker.conditional) for waker in join.wakers] == [('work', True)]
    assert join.escapes is not None
    assert join.escapes.reason == 'work, which ends it, may end by ValueError'


def test_what_is_registered_at_exit_runs_when_the_spin_is_over() -> None:
    """``Thread.join`` in it waits for a thread that only callbacks wake."""
    joins = UPLOAD.replace('REGISTERS', 'atexit.register(self.close)')
    wakes = UPLOAD.replace('REGISTERS', 'atexit.register(self.close, wakes=True)')
    assert (slugs(joins), slugs(wakes)) == (['nobody-spins'], [])


def test_an_error_that_ends_a_thread_is_what_a_join_waits_for() -> None:
    text = ARCHIVE.replace('TESTS', 'if not line: raise ValueError(line)')
    starts = 'threading.Thread(target=self.work, daemon=True)'
    text = text.replace(
        f'{starts}.start()', f'self.thread = {starts}\n        self.thread.start()'
    )
    (join,) = waits(text.replace('self.jobs.join()', 'self.thread.join()'), 'flush')
    reason = 'work, which ends it, may end by ValueError'
    assert join.escapes is None or join.escapes.reason != reason


REPEATED = """\
        for line in iter(self.jobs.get, None):
            self.get_logger().info(line)
"""
COLLECTED = '        return [line for line in iter(self.jobs.get, None)]\n'


@pytest.mark.parametrize('loop', [REPEATED, COLLECTED])
def test_a_repeated_call_with_a_sentinel_waits_in_each_round(loop: str) -> None:
    """``iter(queue.get, None)`` takes out what is put in, round by round."""
    begin = ARCHIVE.index('        while True:')
    text = f'{ARCHIVE[:begin]}{loop}\nrclpy.init()\nrclpy.spin(Archive())\n'
    text = text.replace('queue.Queue()', 'queue.Queue(maxsize=4)')
    (unit,) = scan_text(text).units
    get = unit.activities[0].blocking[0]
    assert (get.call, [waker.by for waker in get.wakers]) == ('Queue.get', ['take'])
    (put,) = waits(text, 'take')
    assert [waker.by for waker in put.wakers] == ['work' if loop is COLLECTED else TIME]
