"""A17: two callbacks of a pool step one inner executor, each until its answer has come. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Relay(Node):
    def __init__(self, client):
        super().__init__('relay')
        self.client = client
        self.create_timer(0.1, self.take_off, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.1, self.land, callback_group=MutuallyExclusiveCallbackGroup())

    def take_off(self):
        self.ask()

    def land(self):
        self.ask()

    def ask(self):
        self.client.call_async(Trigger.Request()).add_done_callback(self.go_on)

    def go_on(self, future):
        self.get_logger().info('done')


def main():
    rclpy.init()
    asker = rclpy.create_node('asker')
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(asker)
    executor.add_node(Relay(asker.create_client(Trigger, 'task')))
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
