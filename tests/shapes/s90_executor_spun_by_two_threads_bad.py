"""Two threads spin one executor."""

import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Chatter(Node):
    def __init__(self):
        super().__init__('chatter')
        self.create_timer(0.05, self.talk)

    def talk(self):
        time.sleep(0.02)
        print('goes on')


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Chatter())
    threading.Thread(target=executor.spin, daemon=True).start()
    executor.spin()  # breaks here


if __name__ == '__main__':
    main()
