"""D4: the executor spins until the answer has come."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'answer')


def main():
    rclpy.init()
    node = Asker()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.spin_until_future_complete(node.client.call_async(Trigger.Request()))


if __name__ == '__main__':
    main()

# rclpy: 7.1.9

# finds: nothing
