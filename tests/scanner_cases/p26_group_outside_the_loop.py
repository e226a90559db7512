"""P26: a group made outside the loop is shared, one made inside is not."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        shared = ReentrantCallbackGroup()
        for name in ['x', 'y']:
            self.create_subscription(String, name, self.on_shared, 10, callback_group=shared)
            own = MutuallyExclusiveCallbackGroup()
            self.create_timer(1.0, self.tick, callback_group=own)

    def on_shared(self, msg):
        pass

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group shared REENTRANT
#   group own EXCLUSIVE
#   group own_2 EXCLUSIVE
#   timer tick in own every 1
#   timer tick_2 in own_2 (A.tick) every 1
#   subscription x_on_shared in shared (A.on_shared) key=x
#   subscription y_on_shared in shared (A.on_shared) key=y
