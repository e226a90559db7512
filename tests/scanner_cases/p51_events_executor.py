"""P51: the events executor."""
# live: no, its spin cannot be stopped from Python

import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = EventsExecutor()
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: EventsExecutor x1 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
