"""Retry: a timer tries again and again, with pauses, and starves a subscription."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty, Int32


def retry(times, pause):
    """Call again until it is true."""

    def decorate(function):
        def inner(*args, **kwargs):
            for _ in range(times):
                if function(*args, **kwargs):
                    return True
                time.sleep(pause)
            return False

        return inner

    return decorate


class Prober(Node):
    """Probes a port that is never open."""

    def __init__(self):
        super().__init__('prober')
        self.beats = self.create_publisher(Empty, 'beat', 10)
        self.create_timer(0.1, self.beat)
        self.create_timer(1.0, self.probe)
        self.create_subscription(Int32, 'order', self.on_order, 1)
        self.orders = 0

    @retry(times=5, pause=0.3)
    def probe(self):
        return self.orders < 0

    def beat(self):
        self.beats.publish(Empty())

    def on_order(self, _msg):
        self.orders += 1


def main():
    rclpy.init()
    rclpy.spin(Prober())


if __name__ == '__main__':
    main()
