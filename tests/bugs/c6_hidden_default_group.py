"""C6: topics stop during homing, since the default group holds it all."""

import time

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.publish_joints)
        self.create_service(Trigger, 'home', self.on_home)

    def publish_joints(self):
        self.get_logger().info('joints')

    def on_home(self, request, response):
        time.sleep(20.0)
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC201:21 warning, CC401:27 warning
