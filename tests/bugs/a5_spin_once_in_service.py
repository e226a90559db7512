"""A5: "wait set index too big", since a callback steps its own node."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Gripper(Node):
    def __init__(self):
        super().__init__('gripper')
        self.is_closed = False
        self.create_subscription(String, 'closed', self.on_closed, 10)
        self.create_service(Trigger, 'close', self.on_close)

    def on_closed(self, msg):
        self.is_closed = True

    def on_close(self, request, response):
        while not self.is_closed:
            rclpy.spin_once(self)
        return response


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Gripper())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC106:22
