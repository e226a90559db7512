"""As many callbacks wait for answers as the executor has threads."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arms(Node):
    def __init__(self):
        super().__init__('arms')
        self.create_timer(0.5, self.move_left, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.move_right, callback_group=MutuallyExclusiveCallbackGroup())
        group = ReentrantCallbackGroup()
        self.left = self.create_client(Trigger, 'left', callback_group=group)
        self.right = self.create_client(Trigger, 'right', callback_group=group)

    def move_left(self):
        self.left.call(Trigger.Request())  # waits here
        print('goes on')

    def move_right(self):
        self.right.call(Trigger.Request())  # waits here


class Controller(Node):
    def __init__(self):
        super().__init__('controller')
        self.create_service(Trigger, 'left', self.on_request)
        self.create_service(Trigger, 'right', self.on_request)

    def on_request(self, request, response):
        time.sleep(0.05)
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arms())
    executor.add_node(Controller())
    executor.spin()


if __name__ == '__main__':
    main()
