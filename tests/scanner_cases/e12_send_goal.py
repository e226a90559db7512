"""EffectLog: the blocking calls of an action client."""
# live: no, no action type among the wheels

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.client = ActionClient(self, Fibonacci, 'fibonacci')
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.client.wait_for_server(timeout_sec=3.0)
        self.client.send_goal(Fibonacci.Goal())


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks wait_for_server on fibonacci_action_client 3.0 s @17
#     blocks send_goal on fibonacci_action_client @18
#   action_client fibonacci_action_client in a_default key=fibonacci
