"""A service callback calls another service by `spin_until_future_complete` on its node."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Mission(Node):
    def __init__(self):
        super().__init__('mission')
        self.create_service(Trigger, 'start', self.on_start)
        self.client = self.create_client(Trigger, 'localise')

    def on_start(self, request, response):
        future = self.client.call_async(Trigger.Request())
        # differs: spin-refused-twice
        rclpy.spin_until_future_complete(self, future, timeout_sec=1.0)
        print('localised', future.done(), flush=True)
        response.success = True
        return response


class Localiser(Node):
    def __init__(self):
        super().__init__('localiser')
        self.create_service(Trigger, 'localise', self.on_localise)
        self.starter = self.create_client(Trigger, 'start')
        self.create_timer(0.7, self.start)

    def on_localise(self, request, response):
        response.success = True
        return response

    def start(self):
        if self.starter.service_is_ready():
            self.starter.call_async(Trigger.Request())


def main():
    rclpy.init()
    others = SingleThreadedExecutor()
    others.add_node(Localiser())
    threading.Thread(target=others.spin, daemon=True).start()
    rclpy.spin(Mission())


if __name__ == '__main__':
    main()
