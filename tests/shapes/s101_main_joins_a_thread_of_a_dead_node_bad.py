"""Main joins a thread that waits for an event of a node that nobody spins."""

import threading

import rclpy
from rclpy.node import Node


class Station(Node):
    def __init__(self):
        super().__init__('station')
        self.arrived = threading.Event()
        self.create_timer(0.3, self.on_train)

    def on_train(self):
        self.arrived.set()

    def wait_for_train(self):
        self.arrived.wait()  # waits here
        print('goes on')


def main():
    rclpy.init()
    node = Station()
    passenger = threading.Thread(target=node.wait_for_train, daemon=True)
    passenger.start()
    passenger.join()  # waits here
    rclpy.shutdown()


if __name__ == '__main__':
    main()
