"""Offers ``own`` and needs ``other``; a parameter says in which order, and how it waits."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Starter(Node):
    def __init__(self):
        super().__init__('starter')
        self.other = self.create_client(Trigger, 'other')
        if self.declare_parameter('offers_first', False).value:
            self.create_service(Trigger, 'own', self.on_own)
            self.wait_for_other()
        else:
            self.wait_for_other()
            self.create_service(Trigger, 'own', self.on_own)
        print('goes on', flush=True)

    def wait_for_other(self):
        print('asks', flush=True)
        while not self.other.wait_for_service(timeout_sec=0.5):
            print('not there', flush=True)

    def on_own(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Starter())


if __name__ == '__main__':
    main()
