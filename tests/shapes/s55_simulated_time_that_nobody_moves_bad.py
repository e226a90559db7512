"""A thread sleeps on simulated time that nobody publishes."""

import threading

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter


class Sweeper(Node):
    def __init__(self):
        super().__init__('sweeper')
        self.set_parameters([Parameter('use_sim_time', value=True)])
        threading.Thread(target=self.sweep, daemon=True).start()

    def sweep(self):
        while rclpy.ok():
            self.get_clock().sleep_for(Duration(seconds=0.2))  # waits here
            print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Sweeper())


if __name__ == '__main__':
    main()
