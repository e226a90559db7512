"""Point 23: a property makes its node when first asked; each owner has one."""
# live: no, it depends on the command line which node is made

import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Inner(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


class Strategy:
    def __init__(self, name):
        self._name = name
        self._node = Inner(name) if len(sys.argv) > 1 else None

    @property
    def node(self):
        if self._node is None:
            self._node = Inner(self._name)
        return self._node


def main():
    rclpy.init()
    first, second = Strategy('first'), Strategy('second')
    for strategy in (first, second):
        strategy.node.create_subscription(String, 'x', print, 10)
        strategy.node.create_subscription(String, 'y', print, 10)
    rclpy.spin(first.node)


if __name__ == '__main__':
    main()

# expect:
# unit first: SingleThreadedExecutor x1 rclpy.spin alternative@38.0, main
#   group first_default EXCLUSIVE default
#   timer tick in first_default every 1
#   subscription x_print in first_default (print) key=x conditional
#   subscription y_print in first_default (print) key=y conditional
# unit first: SingleThreadedExecutor x1 rclpy.spin alternative@38.1, main
#   group first_default EXCLUSIVE default
#   timer tick in first_default every 1
#   subscription x_print in first_default (print) key=x conditional
#   subscription y_print in first_default (print) key=y conditional
# unit second: no executor, main
#   group second_default EXCLUSIVE default
#   timer tick in second_default every 1
#   subscription x_print in second_default (print) key=x conditional
#   subscription y_print in second_default (print) key=y conditional
#   ? executor executor
