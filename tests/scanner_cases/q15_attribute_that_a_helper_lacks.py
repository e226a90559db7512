"""Point 15: an entity on an object that cannot make one is a mark on the node concerned alone."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Helper:
    pass


class Left(Node):
    def __init__(self):
        super().__init__('left')
        self.helper = Helper()
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass

    def listen(self):
        self.helper.create_subscription(String, 'x', self.tick, 10)


class Right(Node):
    def __init__(self):
        super().__init__('right')
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    one, other = SingleThreadedExecutor(), MultiThreadedExecutor(2)
    one.add_node(Left())
    other.add_node(Right())
    threading.Thread(target=one.spin, daemon=True).start()
    other.spin()

# expect:
# unit left: one=SingleThreadedExecutor x1 spin in thread, main
#   group left_default EXCLUSIVE default
#   timer tick in left_default every 1
#   ? left entities
# unit right: other=MultiThreadedExecutor x2 spin, main
#   group right_default EXCLUSIVE default
#   timer tick in right_default every 1
