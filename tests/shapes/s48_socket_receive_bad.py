"""A callback receives from a socket to which nobody sends."""

import socket

import rclpy
from rclpy.node import Node


class Lidar(Node):
    def __init__(self):
        super().__init__('lidar')
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(('127.0.0.1', 0))
        self.create_timer(0.5, self.receive)

    def receive(self):
        self.socket.recv(1500)  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Lidar())


if __name__ == '__main__':
    main()
