"""Publishes the time of a simulation, twice as fast as time is."""

import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rosgraph_msgs.msg import Clock as ClockMessage


class Simulator(Node):
    def __init__(self):
        super().__init__('simulator')
        self.clock = self.create_publisher(ClockMessage, '/clock', 10)
        self.now_ms = 0
        self.create_timer(0.05, self.tick, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def tick(self):
        self.now_ms += 100
        message = ClockMessage()
        message.clock.sec = self.now_ms // 1000
        message.clock.nanosec = self.now_ms % 1000 * 1000000
        self.clock.publish(message)


def main():
    rclpy.init()
    rclpy.spin(Simulator())


if __name__ == '__main__':
    main()
