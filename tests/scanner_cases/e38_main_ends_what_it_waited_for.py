"""EffectLog: what main destroys behind a wait is there while it waits."""

import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.seen = False
        self.create_subscription(String, 'x', self.on_x, 10)

    def on_x(self, msg):
        self.seen = True


def main():
    rclpy.init()
    node = A()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    while not node.seen:
        time.sleep(0.1)
    executor.shutdown()
    node.destroy_node()


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 spin in thread, main
#   group a_default EXCLUSIVE default
#   subscription on_x in a_default key=x
#     writes A.seen @19
#   activity main main
#     blocks time.sleep 0.1 s @29
#     blocks polling loop on on_x through A.seen @28
#       ended by on_x @19
#     reads A.seen @28
