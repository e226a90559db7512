"""A callback on one thread waits for an event that a done-callback sets. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'light', callback_group=group)
        self.create_service(Trigger, 'light', self.on_light, callback_group=group)
        self.answered = threading.Event()
        self.create_timer(0.5, self.switch)

    def switch(self):
        self.answered.clear()
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(self.on_answer)
        self.answered.wait()
        print('goes on')

    def on_answer(self, future):
        self.answered.set()

    def on_light(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Lamp())
    executor.spin()


if __name__ == '__main__':
    main()
