"""A callback loops until simulated time has passed, in a group of its own. Mended."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String


class Walker(Node):
    def __init__(self):
        use = Parameter('use_sim_time', value=True)
        super().__init__('walker', parameter_overrides=[use])
        group = MutuallyExclusiveCallbackGroup()
        self.create_subscription(String, 'step', self.on_step, 10, callback_group=group)

    def on_step(self, msg):
        start = self.get_clock().now()
        while (self.get_clock().now() - start).nanoseconds < 2e8:
            time.sleep(0.05)
        print('goes on')


class Simulator(Node):
    def __init__(self):
        super().__init__('simulator')
        self.now = 0
        self.clock = self.create_publisher(Clock, 'clock', 10)
        self.steps = self.create_publisher(String, 'step', 10)
        self.create_timer(0.1, self.advance)
        self.create_timer(1.0, self.step)

    def advance(self):
        self.now += 100_000_000
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(self.now, 1_000_000_000)
        self.clock.publish(message)

    def step(self):
        self.steps.publish(String())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Walker())
    executor.add_node(Simulator())
    executor.spin()


if __name__ == '__main__':
    main()
