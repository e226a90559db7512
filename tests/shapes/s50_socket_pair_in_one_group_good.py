"""A callback receives what a callback of its own group sends. Mended."""

import socket

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Loopback(Node):
    def __init__(self):
        super().__init__('loopback')
        self.near, self.far = socket.socketpair()
        self.create_timer(0.3, self.receive)
        self.create_timer(0.5, self.send, callback_group=MutuallyExclusiveCallbackGroup())

    def receive(self):
        self.near.recv(1)
        print('goes on')

    def send(self):
        self.far.send(b'x')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Loopback())
    executor.spin()


if __name__ == '__main__':
    main()
