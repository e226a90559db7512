"""A callback waits for an event that code out of sight may set."""

import threading
from importlib import import_module

import rclpy
from rclpy.node import Node


class Feeder(Node):
    def __init__(self):
        super().__init__('feeder')
        self.arrived = threading.Event()
        self.plant = import_module('queue').Queue()
        self.plant.put(self.arrived)
        self.create_timer(0.3, self.feed)

    def feed(self):
        self.arrived.wait()
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Feeder())


if __name__ == '__main__':
    main()
