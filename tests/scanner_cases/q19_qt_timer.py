"""Point 19: timers of a user interface are no ROS timers."""
# live: no, needs a user interface

import rclpy
from PyQt5.QtCore import QTimer
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.refresh = QTimer()
        self.refresh.timeout.connect(self.paint)
        self.refresh.start(30)
        self.create_timer(0.5, self.tick)

    def paint(self):
        pass

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
