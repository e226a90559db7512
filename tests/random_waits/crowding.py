"""Smallest programs in which runs of one callback hold each other up, and their clean twins."""

from __future__ import annotations

_EVENT = """\
    def __init__(self):
        super().__init__('crowd')
        self.given = threading.{made}
        self.create_timer(0.05, self.ask, callback_group={group}())
        self.create_timer(1.5, self.tell, callback_group=MutuallyExclusiveCallbackGroup())

    def ask(self):
        self.given.{wait}()

    def tell(self):
        self.given.{end}()
"""
_LOCK = """\
    def __init__(self):
        super().__init__('crowd')
        self.lock = threading.Lock()
        self.answer = Future()
        self.create_timer(0.05, self.ask, callback_group={group}())
        self.create_timer(1.5, self.tell, callback_group=MutuallyExclusiveCallbackGroup())

    async def ask(self):
        with self.lock:
            await self.answer

    def tell(self):
        self.answer.set_result(None)
"""
_CALL = """\
    def __init__(self):
        super().__init__('crowd')
        own = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'crowd_tell', callback_group=own)
        self.create_timer(0.05, self.ask, callback_group={group}())
        other = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'crowd_tell', self.tell, callback_group=other)

    def ask(self):
        time.sleep(0.2)  # the next run has begun before anybody asks
        self.client.call(Trigger.Request())

    def tell(self, request, response):
        return response
"""
_TASK = """\
    def __init__(self):
        super().__init__('crowd')
        self.given = threading.Event()
        self.create_timer(1.5, self.tell, callback_group=MutuallyExclusiveCallbackGroup())

    def ask(self):
        self.given.wait()

    def tell(self):
        self.given.set()
"""
_PROGRAM = """\
import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger


class Crowd(Node):
{body}

def main():
    rclpy.init()
    executor = {executor}
    executor.add_node(Crowd())
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
"""
_ANY, _ONE_BY_ONE = 'ReentrantCallbackGroup', 'MutuallyExclusiveCallbackGroup'
_EVENTS = {'made': 'Event()', 'wait': 'wait', 'end': 'set'}
_SEMAPHORES = {'made': 'Semaphore(0)', 'wait': 'acquire', 'end': 'release'}


def _program(body: str, group: str, threads: int, **names: str) -> str:
    executor = f'MultiThreadedExecutor(num_threads={threads})'
    return _PROGRAM.format(
        body=body.format(group=group, **names),
        executor='SingleThreadedExecutor()' if threads == 1 else executor,
    )


_MAKES = '    executor.create_task(crowd.ask)\n'


def _with_tasks(made: str) -> str:
    """Tasks that are made before the spin, on two threads."""
    added = '    executor.add_node(Crowd())\n'
    crowd = f'    crowd = Crowd()\n    executor.add_node(crowd)\n{made}'
    return _program(_TASK, '', 2).replace(added, crowd)


HANG = {
    'event': _program(_EVENT, _ANY, 2, **_EVENTS),
    'event_on_six_threads': _program(_EVENT, _ANY, 6, **_EVENTS),
    'semaphore': _program(_EVENT, _ANY, 3, **_SEMAPHORES),
    'call': _program(_CALL, _ANY, 2),
    'lock_on_one_thread': _program(_LOCK, _ANY, 1),
    'lock_on_three_threads': _program(_LOCK, _ANY, 3),
    'two_tasks': _with_tasks(_MAKES * 2),
    'tasks_of_a_loop': _with_tasks(f'    for _ in range(2):\n    {_MAKES}'),
}
END = {
    'event': _program(_EVENT, _ONE_BY_ONE, 2, **_EVENTS),
    'call': _program(_CALL, _ONE_BY_ONE, 2),
    'lock_on_one_thread': _program(_LOCK, _ONE_BY_ONE, 1),
    'lock_on_three_threads': _program(_LOCK, _ONE_BY_ONE, 3),
    'one_task': _with_tasks(_MAKES),
}
