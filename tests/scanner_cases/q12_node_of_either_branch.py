"""Point 12: a node of either branch in one executor: what it makes is never certain."""

import sys

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(1.0, self.move)

    def move(self):
        pass


class Leg(Node):
    def __init__(self):
        super().__init__('leg')
        self.create_timer(1.0, self.walk)

    def walk(self):
        pass


class Eye(Node):
    def __init__(self):
        super().__init__('eye')
        self.create_timer(1.0, self.look)

    def look(self):
        pass


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Eye())
    if len(sys.argv) > 1:
        executor.add_node(Arm())
    else:
        executor.add_node(Leg())
    executor.spin()


# expect:
# unit eye_and_2_more: SingleThreadedExecutor x1 spin, main
#   nodes eye, arm, leg
#   group eye_default EXCLUSIVE default
#   group arm_default EXCLUSIVE default
#   group leg_default EXCLUSIVE default
#   timer look in eye_default every 1 node=eye
#   timer move in arm_default every 1 node=arm conditional alternative@41.0
#   timer walk in leg_default every 1 node=leg conditional alternative@41.1
