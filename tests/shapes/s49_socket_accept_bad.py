"""A callback accepts a connection that nobody makes."""

import socket

import rclpy
from rclpy.node import Node


class Console(Node):
    def __init__(self):
        super().__init__('console')
        self.server = socket.create_server(('127.0.0.1', 0))
        self.create_timer(0.5, self.work)
        self.create_timer(0.3, self.listen)

    def work(self):
        print('goes on')

    def listen(self):
        connection, _ = self.server.accept()  # waits here
        connection.close()


def main():
    rclpy.init()
    rclpy.spin(Console())


if __name__ == '__main__':
    main()
