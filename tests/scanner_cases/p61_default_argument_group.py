"""P61, point 6: a default argument is evaluated once: one group for all calls and nodes."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self, name):
        super().__init__(name)
        self.add('x')
        self.add('y')

    def add(self, topic, g=MutuallyExclusiveCallbackGroup()):
        self.create_subscription(String, topic, self.cb, 10, callback_group=g)

    def cb(self, msg):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A('one'))
    executor.add_node(A('two'))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit one_and_two: MultiThreadedExecutor x2 spin, main
#   nodes one, two
#   group g EXCLUSIVE
#   subscription one_x_cb in g (A.cb) key=x node=one
#   subscription one_y_cb in g (A.cb) key=y node=one
#   subscription two_x_cb in g (A.cb) key=x node=two
#   subscription two_y_cb in g (A.cb) key=y node=two
