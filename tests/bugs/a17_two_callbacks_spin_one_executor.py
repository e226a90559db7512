"""A17: two callbacks of a pool step one inner executor, each until its answer has come."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Relay(Node):
    def __init__(self, client, inner):
        super().__init__('relay')
        self.client = client
        self.inner = inner
        self.create_timer(0.1, self.take_off, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.1, self.land, callback_group=MutuallyExclusiveCallbackGroup())

    def take_off(self):
        self.ask()

    def land(self):
        self.ask()

    def ask(self):
        future = self.client.call_async(Trigger.Request())
        while not future.done():
            self.inner.spin_once(timeout_sec=0.05)


def main():
    rclpy.init()
    asker = rclpy.create_node('asker')
    inner = SingleThreadedExecutor()
    inner.add_node(asker)
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Relay(asker.create_client(Trigger, 'task'), inner))
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC107:27, CC121:26 note, CC501:27 note
