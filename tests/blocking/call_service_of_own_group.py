"""A synchronous call to a service of the same node in the group of the caller."""

import rclpy
from rclpy import executors
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Caller(Node):
    def __init__(self):
        super().__init__('caller')
        self.create_service(Trigger, 'answer', self.on_answer)
        self.client = self.create_client(
            Trigger, 'answer', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.client.wait_for_service()
        self.timer = self.create_timer(0.1, self.ask)

    def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        self.client.call(Trigger.Request())
        print('goes on', flush=True)

    def on_answer(self, request, response):
        return response


def main():
    rclpy.init()
    node = Caller()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# single: blocks
# multi: blocks
