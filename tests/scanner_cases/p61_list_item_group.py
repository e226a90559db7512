"""P61: groups in a list, by index and in a loop."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.groups = [MutuallyExclusiveCallbackGroup() for _ in range(2)]
        for index, topic in enumerate(['x', 'y', 'z']):
            group = self.groups[index % 2]
            self.create_subscription(String, topic, self.on_any, 10, callback_group=group)

    def on_any(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group EXCLUSIVE
#   group group_2 EXCLUSIVE
#   subscription x_on_any in group (A.on_any) key=x
#   subscription y_on_any in group_2 (A.on_any) key=y
#   subscription z_on_any in group (A.on_any) key=z
