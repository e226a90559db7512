"""A thread sleeps by a rate of a clock that nobody publishes."""

import threading

import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter


class Mower(Node):
    def __init__(self):
        super().__init__('mower')
        self.set_parameters([Parameter('use_sim_time', value=True)])
        self.rate = self.create_rate(5)
        threading.Thread(target=self.mow, daemon=True).start()

    def mow(self):
        while rclpy.ok():
            self.rate.sleep()  # waits here
            print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Mower())


if __name__ == '__main__':
    main()
