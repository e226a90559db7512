"""A1: a timer fires once, since the nested spin takes the node out of its executor."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(
            Trigger, 'answer', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.1, self.tick)
        self.create_subscription(
            String,
            'stop',
            self.on_stop,
            10,
            callback_group=MutuallyExclusiveCallbackGroup(),
        )

    def on_stop(self, msg):
        self.get_logger().info('stop')

    def tick(self):
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Asker())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC106:31
