"""A callback destroys the client whose answer a thread waits for. Mended."""

import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Probe(Node):
    def __init__(self):
        super().__init__('probe')
        self.client = self.create_client(Trigger, 'probe')
        self.create_timer(0.7, self.reset, callback_group=MutuallyExclusiveCallbackGroup())
        threading.Thread(target=self.ask, daemon=True).start()

    def ask(self):
        self.client.wait_for_service()
        while rclpy.ok():
            self.client.call(Trigger.Request())
            print('goes on')

    def reset(self):
        self.get_logger().debug('reset')


class Sensor(Node):
    def __init__(self):
        super().__init__('sensor')
        self.create_service(Trigger, 'probe', self.on_probe)

    def on_probe(self, request, response):
        time.sleep(0.5)
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Probe())
    executor.add_node(Sensor())
    executor.spin()


if __name__ == '__main__':
    main()
