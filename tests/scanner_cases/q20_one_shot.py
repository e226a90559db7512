"""Point 20: a timer that cancels itself; under a condition it is no one-shot."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.once = self.create_timer(1.0, self.on_once)
        self.until = self.create_timer(1.0, self.on_until)
        self.count = 0

    def on_once(self):
        self.once.cancel()

    def on_until(self):
        self.count += 1
        if self.count > 3:
            self.until.cancel()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer on_once in a_default every 1 one_shot
#   timer on_until in a_default every 1
#     reads A.count @19
#     writes A.count update @18
