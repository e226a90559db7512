"""EffectLog: a release in a try of its own fails where the lock is free; other calls fail anywhere."""

import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.seen_lock = threading.Condition()
        self.seen = set()
        self.create_subscription(Int32, 'frames', self.on_frame, 10)
        self.create_subscription(Int32, 'orders', self.on_order, 10)

    def on_frame(self, msg):
        self.seen_lock.acquire()
        if msg.data not in self.seen:
            self.seen.add(msg.data)
            self.seen_lock.release()
            self.get_logger().info('a new frame')
        try:
            self.seen_lock.release()
        except RuntimeError:
            self.get_logger().info('given back before')

    def on_order(self, msg):
        self.seen_lock.acquire()
        try:
            self.seen.remove(msg.data)
            self.seen_lock.release()
        except KeyError:
            self.get_logger().info('not seen')


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_frame in a_default key=frames
#     reads A.seen under seen_lock @20
#     writes A.seen update in_place rests under seen_lock @21
#     locks seen_lock @19
#   subscription on_order in a_default key=orders
#     writes A.seen update in_place under seen_lock @32
#     locks seen_lock @30
# error lock-kept @31
