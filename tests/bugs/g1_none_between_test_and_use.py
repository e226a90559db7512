"""G1: an attribute is tested, another callback sets it to None, and then it is used."""

import threading

import rclpy
from rclpy.action import ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Follower(Node):
    def __init__(self):
        super().__init__('follower')
        self.lock = threading.Lock()
        self.path = ['door', 'lift']
        self.server = ActionServer(self, Fibonacci, 'plan', self.execute)
        group = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'follow', self.on_follow, callback_group=group)
        self.create_timer(0.05, self.drive)

    def execute(self, goal_handle):
        self.path = None
        goal_handle.succeed()
        return Fibonacci.Result()

    def on_follow(self, request, answer):
        if self.path is not None:
            answer.message = f'{len(self.path)} points'
            self.path = None
        return answer

    def drive(self):
        self.get_logger().debug('drives')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Follower())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC303:32 warning
