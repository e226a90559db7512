"""A thread spins an executor, and main spins the node of that executor by another one."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'answer')
        self.create_service(Trigger, 'answer', self.on_request)
        self.create_timer(0.3, self.beat)

    def on_request(self, request, response):
        return response

    def beat(self):
        print('goes on')


def main():
    rclpy.init()
    node = Asker()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    spinning = threading.Thread(target=executor.spin, daemon=True)
    spinning.start()
    future = node.client.call_async(Trigger.Request())
    rclpy.spin_until_future_complete(node, future)
    spinning.join()


if __name__ == '__main__':
    main()
