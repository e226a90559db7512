"""G1: a goal asks whether the arm was stopped, and has it move after the stop all the same."""

import threading

import rclpy
from rclpy.action import ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.lock = threading.Lock()
        self.mode = 'ready'
        self.server = ActionServer(self, Fibonacci, 'move', self.execute)
        self.create_service(Trigger, 'stop', self.on_stop)
        self.create_timer(0.05, self.drive, callback_group=MutuallyExclusiveCallbackGroup())

    def on_stop(self, request, answer):
        self.mode = 'stopped'
        return answer

    def execute(self, goal_handle):
        if self.mode != 'stopped':
            speed = goal_handle.request.order
            self.mode = f'moving at {speed}'
        goal_handle.succeed()
        return Fibonacci.Result()

    def drive(self):
        self.get_logger().info(self.mode)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC303:30 warning
