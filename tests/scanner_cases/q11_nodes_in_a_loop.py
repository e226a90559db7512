"""Point 11: nodes made in a loop over a literal."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    nodes = [A(f'arm_{number}') for number in range(2)]
    for node in nodes:
        executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit arm_0_and_arm_1: SingleThreadedExecutor x1 spin, main
#   nodes arm_0, arm_1
#   group arm_0_default EXCLUSIVE default
#   group arm_1_default EXCLUSIVE default
#   timer arm_0_tick in arm_0_default (A.tick) every 0.5 node=arm_0
#   timer arm_1_tick in arm_1_default (A.tick) every 0.5 node=arm_1
