"""EffectLog: a poll without an end and a wait for a key wait; with a time-out they end."""
# live: no, zmq and cv2 are in no environment

import cv2
import rclpy
import zmq
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.socket = zmq.Context().socket(zmq.REQ)
        self.create_timer(1.0, self.ask)
        self.create_timer(1.0, self.look)

    def ask(self):
        self.socket.poll(timeout=-1)
        self.socket.poll(timeout=10)
        self.socket.poll()

    def look(self):
        cv2.waitKey(1)
        cv2.waitKey(0)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer ask in a_default every 1
#     blocks unknown wait on ? @18
#       ended by ?
#     reads A.socket @18
#     reads A.socket @19
#     reads A.socket @20
#   timer look in a_default every 1
#     blocks cv2.waitKey @24
