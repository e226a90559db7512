"""A call in a callback needs a second thread; how many there are is left to rclpy. CPUs: 1"""

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
            print('calling', flush=True)
            self.client.call(Trigger.Request())
            print('up', flush=True)


def main():
    rclpy.init()
    # differs: threads-by-affinity
    executor = MultiThreadedExecutor()
    executor.add_node(Lift())
    executor.spin()


if __name__ == '__main__':
    main()
