"""Point 5: two instances of one class never share their default group."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.5, self.tick)
        self.create_subscription(String, 'in', self.on_in, 10)

    def tick(self):
        pass

    def on_in(self, msg):
        pass


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    for name in ('left', 'right'):
        executor.add_node(A(name))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit left_and_right: SingleThreadedExecutor x1 spin, main
#   nodes left, right
#   group left_default EXCLUSIVE default
#   group right_default EXCLUSIVE default
#   timer left_tick in left_default (A.tick) every 0.5 node=left
#   subscription left_on_in in left_default (A.on_in) key=in node=left
#   timer right_tick in right_default (A.tick) every 0.5 node=right
#   subscription right_on_in in right_default (A.on_in) key=in node=right
