"""A callback waits for a message that nobody in the program sends."""

import rclpy
from rclpy.node import Node
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import String


class Localizer(Node):
    def __init__(self):
        super().__init__('localizer')
        self.create_timer(0.5, self.localize)

    def localize(self):
        wait_for_message(String, self, 'map')  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Localizer())


if __name__ == '__main__':
    main()
