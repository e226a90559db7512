"""C8: all callbacks are reentrant, also those that cannot bear it."""

import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Feeder(Node):
    def __init__(self):
        super().__init__('feeder')
        self.alarms = 0
        group = ReentrantCallbackGroup()
        self.create_subscription(String, 'watchdog', self.on_watchdog, 10, callback_group=group)
        self.create_service(Trigger, 'choose', self.on_choose, callback_group=group)

    def on_watchdog(self, msg):
        self.alarms += int(msg.data)

    def on_choose(self, request, response):
        time.sleep(2.0)
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Feeder())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC304:22 warning
