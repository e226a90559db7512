"""A9: "already spinning", since a callback spins the executor that runs it."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(
            Trigger, 'answer', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.1, self.tick)

    def tick(self):
        future = self.client.call_async(Trigger.Request())
        self.executor.spin_until_future_complete(future)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Asker())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC107:20 warning
