"""A callback waits for an answer or a message, neither of which its group lets in."""

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
        self.over = threading.Event()
        self.other = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'ask')
        self.create_service(
            Trigger, 'ask', self.on_ask, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_subscription(Empty, 'abort', self.on_abort, 1)
        self.create_timer(0.5, self.work)

    def on_ask(self, request, response):
        return response

    def on_abort(self, msg):
        self.over.set()

    def work(self):
        self.over.clear()
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)
        self.over.wait()  # waits here
        print('goes on')

    def on_answer(self, future):
        self.over.set()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Asker())
    executor.spin()


if __name__ == '__main__':
    main()
