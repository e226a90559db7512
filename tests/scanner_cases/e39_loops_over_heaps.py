"""EffectLog: a loop that takes from a heap until it is empty waits for nobody."""

import heapq

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.due = []
        self.create_timer(1.0, self.search)
        self.create_timer(1.0, self.pump)

    def search(self):
        rows = [(0, 'start')]
        while rows:
            self.get_logger().info(str(heapq.heappop(rows)))

    def pump(self):
        while self.due and self.due[0] < 5:
            heapq.heappop(self.due)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer search in a_default every 1
#   timer pump in a_default every 1
#     reads A.due @22
#     reads A.due item 0 @22
#     reads A.due @23
#     writes A.due update in_place rests later @23
