"""A constructor loops until simulated time has begun, and spins meanwhile. Mended."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock


class Walker(Node):
    def __init__(self):
        use = Parameter('use_sim_time', value=True)
        super().__init__('walker', parameter_overrides=[use])
        while self.get_clock().now().nanoseconds == 0:
            rclpy.spin_once(self, timeout_sec=0.1)
        self.create_timer(0.3, self.step)

    def step(self):
        print('goes on')


class Simulator(Node):
    def __init__(self):
        super().__init__('simulator')
        self.now = 0
        self.clock = self.create_publisher(Clock, 'clock', 10)
        self.create_timer(0.1, self.advance)

    def advance(self):
        self.now += 100_000_000
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(self.now, 1_000_000_000)
        self.clock.publish(message)


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Simulator())
    threading.Thread(target=executor.spin, daemon=True).start()
    rclpy.spin(Walker())


if __name__ == '__main__':
    main()
