"""Point 15: a helper class that receives a node makes no node of its own."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Watchdog:
    def __init__(self, node):
        self.node = node
        self.node.create_timer(1.0, self.check)
        self.node.create_subscription(String, 'beat', self.on_beat, 10)

    def check(self):
        pass

    def on_beat(self, msg):
        pass


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.watchdog = Watchdog(self)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_default EXCLUSIVE default
#   timer check in a_default every 1
#   timer tick in a_default every 0.5
#   subscription on_beat in a_default key=beat
