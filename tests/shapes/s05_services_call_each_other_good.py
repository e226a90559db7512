"""Two services of two nodes call each other. Mended."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Front(Node):
    def __init__(self):
        super().__init__('front')
        clients = ReentrantCallbackGroup()
        self.back = self.create_client(Trigger, 'back', callback_group=clients)
        self.front = self.create_client(Trigger, 'front', callback_group=clients)
        self.create_service(Trigger, 'front', self.on_front)
        self.create_timer(0.5, self.ask, callback_group=clients)

    def ask(self):
        self.front.call_async(Trigger.Request())

    def on_front(self, request, response):
        response = self.back.call(Trigger.Request())
        print('goes on')
        return response


class Back(Node):
    def __init__(self):
        super().__init__('back')
        clients = ReentrantCallbackGroup()
        self.front = self.create_client(Trigger, 'front', callback_group=clients)
        self.create_service(Trigger, 'back', self.on_back)

    def on_back(self, request, response):
        self.front.call_async(Trigger.Request())
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=6)
    executor.add_node(Front())
    executor.add_node(Back())
    executor.spin()


if __name__ == '__main__':
    main()
