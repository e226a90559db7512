"""EffectLog: globals that functions change are read and written."""

import rclpy
from rclpy.node import Node


COUNT = 0
SEEN = []
LIMIT = 10


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)

    def tick(self):
        global COUNT
        COUNT += 1
        SEEN.append(COUNT)
        if len(SEEN) > LIMIT:
            COUNT = 0


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     reads e03_globals.COUNT @20
#     reads e03_globals.SEEN @21
#     writes e03_globals.COUNT update @19
#     writes e03_globals.SEEN update in_place @20
#     writes e03_globals.COUNT @22
