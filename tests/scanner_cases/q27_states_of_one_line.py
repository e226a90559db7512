"""Point 27: states that one line makes again and again are one, as that line shows."""

import rclpy
from rclpy.node import Node


class Step:
    def __init__(self, before):
        self.before = before

    def loop(self, node):
        return Step(self)


class Walker(Node):
    def __init__(self):
        super().__init__('walker')
        self.state = Step(None)
        self.create_timer(0.1, self.update)

    def update(self):
        self.state = self.state.loop(self)


def main():
    rclpy.init()
    rclpy.spin(Walker())


if __name__ == '__main__':
    main()

# expect:
# unit walker: SingleThreadedExecutor x1 rclpy.spin, main
#   group walker_default EXCLUSIVE default
#   timer update in walker_default every 0.1
#     reads Walker.state @22
#     writes Walker.state rests later @22
