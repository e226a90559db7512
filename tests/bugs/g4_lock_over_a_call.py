"""G4: a timer calls while it holds a lock, and the group of its client is kept by who wants it."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.lock = threading.Lock()
        self.reads = 0
        drive = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.002, self.read, callback_group=drive)
        self.planner = self.create_client(Trigger, 'plan', callback_group=drive)
        self.planner.wait_for_service()
        self.create_timer(0.05, self.plan_ahead)

    def read(self):
        with self.lock:
            self.reads += 1

    def plan_ahead(self):
        with self.lock:
            answer = self.planner.call(Trigger.Request())
            self.get_logger().info(f'{answer.message} after {self.reads}')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC115:29
