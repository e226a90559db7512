"""A goal is sent and waited for; the client is in the exclusive group of the caller."""

import rclpy
from answering import count_elsewhere
from rclpy import executors
from rclpy.action import ActionClient
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Caller(Node):
    def __init__(self):
        super().__init__('caller')
        self.client = ActionClient(self, Fibonacci, 'count')
        self.client.wait_for_server()
        self.timer = self.create_timer(0.1, self.ask)

    def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        self.client.send_goal(Fibonacci.Goal())
        print('goes on', flush=True)


def main():
    rclpy.init()
    count_elsewhere()
    node = Caller()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# single: blocks
# multi: blocks
