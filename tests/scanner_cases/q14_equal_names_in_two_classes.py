"""Point 14: equal function names in two classes of one executor."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'in', self.callback, 10)
        self.create_timer(0.5, self.callback)

    def callback(self, msg=None):
        pass


class B(Node):
    def __init__(self):
        super().__init__('b')
        self.create_subscription(String, 'in', self.callback, 10)

    def callback(self, msg):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.add_node(B())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a_and_b: MultiThreadedExecutor x2 spin, main
#   nodes a, b
#   group a_default EXCLUSIVE default
#   group b_default EXCLUSIVE default
#   timer a_callback in a_default (A.callback) every 0.5 node=a
#   subscription a_in_callback in a_default (A.callback) key=in node=a
#   subscription b_in_callback in b_default (B.callback) key=in node=b
