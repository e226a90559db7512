"""A callback sends a goal and waits for its result in the group of the client."""

import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Rover(Node):
    def __init__(self):
        super().__init__('rover')
        self.action = ActionClient(self, Fibonacci, 'drive')
        self.create_timer(0.5, self.drive)

    def drive(self):
        self.action.send_goal(Fibonacci.Goal())  # waits here
        print('goes on')


class Wheels(Node):
    def __init__(self):
        super().__init__('wheels')
        self.server = ActionServer(self, Fibonacci, 'drive', self.turn)

    def turn(self, goal_handle):
        goal_handle.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Rover())
    executor.add_node(Wheels())
    executor.spin()


if __name__ == '__main__':
    main()
