"""Where others may end a wait too, a done-callback comes behind the answer of its client."""

from __future__ import annotations

import pytest

from tests.random_waits.suite import ENDS, FOUND, judge

PROGRAM = """\
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.own, self.first, self.second = (MutuallyExclusiveCallbackGroup() for _ in range(3))
        self.over = threading.Event()
        self.client = self.create_client(Trigger, 'ask', callback_group=self.{client})
        self.create_service(Trigger, 'ask', self.on_ask, callback_group=self.{server})
        self.create_subscription(Empty, 'abort', self.on_abort, 10, callback_group=self.own)
        self.create_timer(0.5, self.work, callback_group=self.own)

    def on_ask(self, request, response):
        return response

    def on_abort(self, msg):
        self.over.set()

    def work(self):
        self.over.clear()
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)
        self.over.wait()

    def on_answer(self, future):
        self.over.set()


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Asker())
executor.spin()
"""


@pytest.mark.parametrize(
    ('client', 'server', 'verdict'),
    [('first', 'second', ENDS), ('own', 'second', FOUND), ('first', 'own', FOUND)],
)
def test_it_is_no_help_where_no_answer_can_come(client: str, server: str, verdict: str) -> None:
    assert judge(PROGRAM.format(client=client, server=server))['work'] == verdict
