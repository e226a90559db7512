"""A second node is made and never given to an executor. Mended."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Sender(Node):
    def __init__(self):
        super().__init__('sender')
        self.publisher = self.create_publisher(String, 'line', 10)
        self.create_timer(0.2, self.send)

    def send(self):
        self.publisher.publish(String())


class Printer(Node):
    def __init__(self):
        super().__init__('printer')
        self.create_subscription(String, 'line', self.on_line, 10)

    def on_line(self, msg):
        print('goes on')


def main():
    rclpy.init()
    sender = Sender()
    executor = SingleThreadedExecutor()
    executor.add_node(Printer())
    executor.add_node(sender)
    executor.spin()


if __name__ == '__main__':
    main()
