"""Four callbacks of a reentrant group call at once, on four workers."""

import threading

import rclpy
from answering import answer_elsewhere
from rclpy import executors
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Caller(Node):
    def __init__(self):
        super().__init__('caller')
        group = ReentrantCallbackGroup()
        self.all_here = threading.Barrier(4, timeout=5)
        self.client = self.create_client(Trigger, 'answer', callback_group=group)
        self.client.wait_for_service()
        self.create_timer(0.1, self.ask_first, callback_group=group)
        self.create_timer(0.1, self.ask_second, callback_group=group)
        self.create_timer(0.1, self.ask_third, callback_group=group)
        self.create_timer(0.1, self.ask_fourth, callback_group=group)

    def ask_first(self):
        self.ask()

    def ask_second(self):
        self.ask()

    def ask_third(self):
        self.ask()

    def ask_fourth(self):
        self.ask()

    def ask(self):
        self.all_here.wait()
        print('asks', flush=True)
        self.client.call(Trigger.Request())
        print('goes on', flush=True)


def main():
    rclpy.init()
    answer_elsewhere()
    node = Caller()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# multi: blocks
