"""Point 23: a class hands what it lacks on to its node."""

import rclpy
from std_msgs.msg import String


class Direct:
    def __init__(self):
        self.node = rclpy.create_node('direct')

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.node.destroy_node()

    def __getattr__(self, name):
        return getattr(self.node, name)


class Verb:
    def main(self):
        with Direct() as node:
            node.create_subscription(String, 'x', self.on_x, 10)
            rclpy.spin(node)

    def on_x(self, msg):
        pass


def main():
    rclpy.init()
    Verb().main()


if __name__ == '__main__':
    main()

# expect:
# unit direct: SingleThreadedExecutor x1 rclpy.spin, main
#   group direct_default EXCLUSIVE default
#   subscription on_x in direct_default key=x
