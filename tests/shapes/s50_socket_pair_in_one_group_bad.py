"""A callback receives what a callback of its own group sends."""

import socket

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Loopback(Node):
    def __init__(self):
        super().__init__('loopback')
        self.near, self.far = socket.socketpair()
        self.create_timer(0.3, self.receive)
        self.create_timer(0.5, self.send)

    def receive(self):
        self.near.recv(1)  # waits here
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
