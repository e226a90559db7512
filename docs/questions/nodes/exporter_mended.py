"""A thread that nobody wakes keeps the process alive behind Ctrl-C. Mended."""

import threading
from contextlib import suppress

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class Exporter(Node):
    def __init__(self):
        super().__init__('exporter')
        self.full = threading.Event()
        self.create_subscription(String, 'rows', self.on_rows, 10)
        threading.Thread(target=self.export).start()

    def on_rows(self, message):
        self.get_logger().info('row')

    def export(self):
        while rclpy.ok():
            if self.full.wait(timeout=0.2):
                print('exports')


def main():
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Exporter())


if __name__ == '__main__':
    main()
