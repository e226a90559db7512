"""Point 18: without a ``main`` each function that spins is a start, but one that others call."""
# live: no, the second node is spun when the first has ended

import rclpy
from rclpy.node import Node


class Talker(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(1.0, self.talk)

    def talk(self):
        pass


def spin_one(name='talker'):
    rclpy.spin(Talker(name))


def run_both():
    rclpy.init()
    spin_one('left')
    rclpy.spin(Talker('right'))

# expect:
# unit left: SingleThreadedExecutor x1 rclpy.spin, run_both
#   group left_default EXCLUSIVE default
#   timer talk in left_default every 1
# unit right: SingleThreadedExecutor x1 rclpy.spin, run_both
#   group right_default EXCLUSIVE default
#   timer talk in right_default every 1
