"""A callback asks the user at the terminal."""

import rclpy
from rclpy.node import Node


class Keyboard(Node):
    def __init__(self):
        super().__init__('keyboard')
        self.command = ''
        self.create_timer(0.5, self.drive)
        self.create_timer(0.3, self.ask)

    def drive(self):
        print('goes on')

    def ask(self):
        self.command = input()  # waits here


def main():
    rclpy.init()
    rclpy.spin(Keyboard())


if __name__ == '__main__':
    main()
