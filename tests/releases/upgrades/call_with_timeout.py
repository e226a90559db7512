"""A call with a time-out, which is answered in time."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Lift(Node):
    def __init__(self):
        super().__init__('lift')
        self.create_service(
            Trigger, 'up', self.on_up, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.client = self.create_client(
            Trigger, 'up', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.3, self.go, callback_group=MutuallyExclusiveCallbackGroup())

    def on_up(self, request, response):
        response.success = True
        return response

    def go(self):
        if self.client.service_is_ready():
            # differs: call-takes-timeout
            answer = self.client.call(Trigger.Request(), timeout_sec=5.0)
            print('up', answer.success, flush=True)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Lift())
    executor.spin()


if __name__ == '__main__':
    main()
