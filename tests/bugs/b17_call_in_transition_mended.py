"""B17: a transition asks a service; it runs in a service of the node's default group. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_srvs.srv import Trigger


class Lamp(LifecycleNode):
    def __init__(self):
        super().__init__('lamp')
        self.supply = self.create_client(
            Trigger, 'supply', callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_configure(self, state):
        self.supply.call(Trigger.Request())
        self.create_timer(1.0, self.report, callback_group=MutuallyExclusiveCallbackGroup())
        return TransitionCallbackReturn.SUCCESS

    def report(self):
        self.get_logger().info('on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Lamp())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
