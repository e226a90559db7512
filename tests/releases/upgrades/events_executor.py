"""A node on the EventsExecutor."""

import rclpy
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.node import Node


class Imu(Node):
    def __init__(self):
        super().__init__('imu')
        self.create_timer(0.2, self.read)

    def read(self):
        print('read', flush=True)


def main():
    rclpy.init()
    # differs: events-executor
    executor = EventsExecutor()
    executor.add_node(Imu())
    while rclpy.ok():
        executor.spin_once(timeout_sec=1.0)


if __name__ == '__main__':
    main()
