"""Send one goal to the action server of node.py, print the result, end."""

import argparse

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from test_msgs.action import Fibonacci


class FibonacciClient(Node):
    """Asks for one sequence."""

    def __init__(self) -> None:
        super().__init__('fibonacci_client')
        self.client = ActionClient(self, Fibonacci, 'fibonacci')


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--order', type=int, default=8, help='length of the sequence')
    parser.add_argument('--cancel', action='store_true', help='cancel the goal at once')
    options, ros_arguments = parser.parse_known_args()
    rclpy.init(args=ros_arguments)
    node = FibonacciClient()
    node.client.wait_for_server()
    sent = node.client.send_goal_async(Fibonacci.Goal(order=options.order))
    rclpy.spin_until_future_complete(node, sent)
    goal = sent.result()
    if options.cancel:
        rclpy.spin_until_future_complete(node, goal.cancel_goal_async())
    answer = goal.get_result_async()
    rclpy.spin_until_future_complete(node, answer)
    print('sequence', *answer.result().result.sequence)
    rclpy.try_shutdown()


if __name__ == '__main__':
    main()
