"""A lock that the done-callback gives back, whose client is in another group."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.answered = threading.Lock()
        self.other = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'ask', callback_group=self.other)
        self.create_service(
            Trigger, 'ask', self.on_ask, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.5, self.work)

    def on_ask(self, request, response):
        return response

    def work(self):
        self.answered.acquire()
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_answer)
        self.answered.acquire()
        self.answered.release()
        print('goes on')

    def on_answer(self, future):
        self.answered.release()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Asker())
    executor.spin()


if __name__ == '__main__':
    main()
