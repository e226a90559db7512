"""A callback asks by a node and an executor that nobody else spins."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Mission(Node):
    def __init__(self):
        super().__init__('mission')
        self.asking_node = rclpy.create_node('asking')
        self.asking = SingleThreadedExecutor()
        self.asking.add_node(self.asking_node)
        self.client = self.asking_node.create_client(Trigger, 'localise')
        self.create_timer(0.7, self.ask)

    def ask(self):
        future = self.client.call_async(Trigger.Request())
        self.asking.spin_until_future_complete(future, timeout_sec=1.0)
        print('asked', flush=True)


class Localiser(Node):
    def __init__(self):
        super().__init__('localiser')
        self.create_service(Trigger, 'localise', self.on_localise)

    def on_localise(self, request, response):
        response.success = True
        return response


def main():
    rclpy.init()
    others = SingleThreadedExecutor()
    others.add_node(Localiser())
    threading.Thread(target=others.spin, daemon=True).start()
    rclpy.spin(Mission())


if __name__ == '__main__':
    main()
