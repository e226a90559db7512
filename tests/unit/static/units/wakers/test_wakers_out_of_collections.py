"""Who ends a wait may take what is waited for out of a dictionary, under a key of a message."""

from __future__ import annotations

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import Blocking

PROGRAM = """\
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Job:
    def __init__(self):
        self.finished = threading.Event()

class Desk(Node):
    def __init__(self):
        super().__init__('desk')
        self.waiting = {}
        self.number = 0
        self.create_subscription(
            String, 'done', self.on_done, 10, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(1.0, self.work)

    def on_done(self, msg):
        ENDS

    def work(self):
        self.number += 1
        made = MADE
        self.waiting[self.number] = made
        WAITS

rclpy.init()
executor = MultiThreadedExecutor(2)
executor.add_node(Desk())
executor.spin()
"""


def wait(made: str, waits: str, ends: str) -> Blocking:
    text = PROGRAM.replace('MADE', made).replace('WAITS', waits).replace('ENDS', ends)
    (unit,) = scan_text(text).units
    (work,) = (each for each in unit.callbacks if each.name == 'work')
    (blocking,) = work.blocking
    return blocking


def test_an_event_of_a_dictionary_is_set_by_who_takes_it_out() -> None:
    of_event = wait('threading.Event()', 'made.wait()', 'self.waiting[int(msg.data)].set()')
    assert [waker.by for waker in of_event.wakers] == ['on_done']
    of_job = wait('Job()', 'made.finished.wait()', 'self.waiting[int(msg.data)].finished.set()')
    assert [waker.by for waker in of_job.wakers] == ['on_done']


def test_an_event_of_an_object_that_is_not_followed_leaves_the_wait_open() -> None:
    of_job = wait('Job()', 'made.finished.wait()', 'msg.job.finished.set()')
    assert of_job.escapes is not None
    assert 'an object that could not be followed' in of_job.escapes.reason


def test_an_event_of_another_name_does_not() -> None:
    of_job = wait('Job()', 'made.finished.wait()', 'self.waiting[int(msg.data)].begun.set()')
    assert of_job.escapes is None


OF_A_LOOP = """\
import asyncio
import threading
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Hub(Node):
    def __init__(self, loop):
        super().__init__('hub')
        self.loop = loop
        self.waiting = {}
        self.create_subscription(String, 'events', self.on_event, 20)

    def next_event(self, robot):
        future = self.loop.create_future()
        self.waiting.setdefault(robot, []).append(future)
        return future

    def on_event(self, msg):
        for future in self.waiting.pop(msg.data, []):
            self.loop.call_soon_threadsafe(self.deliver, future)

    @staticmethod
    def deliver(future):
        future.set_result(None)

async def serve():
    hub = Hub(asyncio.get_running_loop())
    executor = SingleThreadedExecutor()
    executor.add_node(hub)
    threading.Thread(target=executor.spin, daemon=True).start()
    await hub.next_event('mule')

def main():
    rclpy.init()
    asyncio.run(serve())

if __name__ == '__main__':
    main()
"""


def test_what_a_run_keeps_in_a_list_of_a_dictionary_is_not_followed_to_an_end() -> None:
    (unit,) = scan_text(OF_A_LOOP).units
    ((blocking,), ()) = (activity.blocking for activity in unit.activities)
    assert not blocking.wakers
    assert blocking.escapes is not None
    assert 'kept in a collection' in blocking.escapes.reason
