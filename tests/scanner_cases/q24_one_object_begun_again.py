"""Point 24: a singleton whose ``__init__`` runs again begins its node anew; the unit says so."""
# live: no, the executor of rclpy holds a node that was begun twice

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Robot(Node):
    _made = None

    def __new__(cls):
        if cls._made is None:
            cls._made = super().__new__(cls)
        return cls._made

    def __init__(self):
        super().__init__('robot')
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Robot())
    executor.add_node(Robot())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit robot: MultiThreadedExecutor x4 spin, main
#   group robot_default EXCLUSIVE default
#   timer tick in robot_default every 1
#   timer tick_2 in robot_default (Robot.tick) every 1
#   ? robot entities
