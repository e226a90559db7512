"""P56: one subscription for each input, one user function."""
# live: no, no message_filters among the wheels

import rclpy
from message_filters import ApproximateTimeSynchronizer, Subscriber
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        a = Subscriber(self, String, 'a')
        b = Subscriber(self, String, 'b')
        self.sync = ApproximateTimeSynchronizer([a, b], 5, 0.1)
        self.sync.registerCallback(self.both)

    def both(self, a, b):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription a_both in a_default (A.both) key=a library=message_filters
#   subscription b_both in a_default (A.both) key=b library=message_filters
