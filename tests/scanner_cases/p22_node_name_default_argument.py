"""P22: a literal default argument names the node."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


NAME = 'arm_one'


class Arm(Node):
    def __init__(self, name='arm'):
        super().__init__(name)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Arm())
    executor.add_node(Arm(NAME))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit arm_and_arm_one: SingleThreadedExecutor x1 spin, main
#   nodes arm, arm_one
#   group arm_default EXCLUSIVE default
#   group arm_one_default EXCLUSIVE default
#   timer arm_tick in arm_default (Arm.tick) every 0.5 node=arm
#   timer arm_one_tick in arm_one_default (Arm.tick) every 0.5 node=arm_one
