"""G4: no service is answered any more: a callback returned with the lock of the mode."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.mode_lock = threading.Lock()
        self.mode = 'position'
        self.create_subscription(
            String,
            'velocity',
            self.on_velocity,
            10,
            callback_group=MutuallyExclusiveCallbackGroup(),
        )
        self.create_service(Trigger, 'switch', self.on_switch)

    def on_velocity(self, msg):
        self.mode_lock.acquire()
        if self.mode != 'navigation':
            return
        self.get_logger().info(msg.data)
        self.mode_lock.release()

    def on_switch(self, request, response):
        with self.mode_lock:
            self.mode = 'navigation'
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Driver())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC112:30
