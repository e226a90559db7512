"""P20: an action client, its feedback, its goal and result answers."""
# live: no, no action type among the wheels

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.client = ActionClient(self, Fibonacci, 'fibonacci')
        self.create_timer(1.0, self.send)

    def send(self):
        future = self.client.send_goal_async(Fibonacci.Goal(), feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_goal)

    def on_feedback(self, feedback):
        pass

    def on_goal(self, future):
        handle = future.result()
        handle.get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer send in a_default every 1
#     changes done_callback @18
#   action_client fibonacci_action_client in a_default (A.on_feedback) key=fibonacci
#   done_callback on_goal in no_group key=fibonacci conditional when=callback
#     changes done_callback @25
#   done_callback on_result in no_group key=fibonacci conditional when=callback
