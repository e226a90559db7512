"""Point 22: full paths."""

import rclpy
import rclpy.callback_groups
import rclpy.executors
import rclpy.node


class A(rclpy.node.Node):
    def __init__(self):
        super().__init__('a')
        self.group = rclpy.callback_groups.ReentrantCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=self.group)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = rclpy.executors.MultiThreadedExecutor(2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group group REENTRANT
#   timer tick in group every 0.5
