"""A callback for a jump of time sleeps on the time that it is called to move."""

import rclpy
from rclpy.clock import JumpThreshold
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock


class Replayer(Node):
    def __init__(self):
        super().__init__('replayer')
        self.set_parameters([Parameter('use_sim_time', value=True)])
        threshold = JumpThreshold(min_forward=Duration(seconds=1), min_backward=None)
        self.jumps = self.get_clock().create_jump_callback(threshold, post_callback=self.on_jump)

    def on_jump(self, jump):
        self.get_clock().sleep_for(Duration(seconds=0.1))  # waits here
        print('goes on')


class Player(Node):
    def __init__(self):
        super().__init__('player')
        self.clock = self.create_publisher(Clock, 'clock', 10)
        self.seconds = 0
        self.create_timer(0.4, self.play)

    def play(self):
        self.seconds += 2
        message = Clock()
        message.clock.sec = self.seconds
        self.clock.publish(message)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Replayer())
    executor.add_node(Player())
    executor.spin()


if __name__ == '__main__':
    main()
