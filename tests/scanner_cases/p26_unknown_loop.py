"""P26: a loop over what the environment says: an unknown number, with a group each."""
# live: no, the number depends on the environment

import os

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        for name in os.environ['ROBOTS'].split():
            group = MutuallyExclusiveCallbackGroup()
            self.create_subscription(
                String, name, lambda msg, n=name: self.on_robot(n, msg), 10, callback_group=group
            )

    def on_robot(self, name, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group EXCLUSIVE count=?
#   subscription lambda_on_robot in group (A.__init__.<locals>.<lambda>) key=? count=?
#   ? lambda_on_robot topic
#   ? lambda_on_robot count
#   ? group count
