"""P57: subclasses that some other package brings: what they make is missing, and the unit says so."""

import rclpy
from rclpy.node import Node


class Plugin:
    def activate(self, node):
        pass


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.create_timer(1.0, self.tick)
        for cls in Plugin.__subclasses__():
            cls().activate(self)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Robot())


# expect:
# unit robot: SingleThreadedExecutor x1 rclpy.spin, main
#   group robot_default EXCLUSIVE default
#   timer tick in robot_default every 1
#   ? robot entities
