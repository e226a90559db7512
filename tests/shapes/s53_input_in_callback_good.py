"""A callback asks the user at the terminal. Mended."""

import threading

import rclpy
from rclpy.node import Node


class Keyboard(Node):
    def __init__(self):
        super().__init__('keyboard')
        self.command = ''
        self.create_timer(0.5, self.drive)
        threading.Thread(target=self.ask, daemon=True).start()

    def drive(self):
        print('goes on')

    def ask(self):
        self.command = input()


def main():
    rclpy.init()
    rclpy.spin(Keyboard())


if __name__ == '__main__':
    main()
