"""A callback on one thread sleeps until a done-callback has set a flag. Mended."""

import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Saver(Node):
    def __init__(self):
        super().__init__('saver')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'save', callback_group=group)
        self.create_service(Trigger, 'save', self.on_save, callback_group=group)
        self.saved = False
        self.create_timer(0.5, self.save)

    def save(self):
        self.saved = False
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_saved)
        while not self.saved:
            time.sleep(0.02)
        print('goes on')

    def on_saved(self, future):
        self.saved = True

    def on_save(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Saver())
    executor.spin()


if __name__ == '__main__':
    main()
