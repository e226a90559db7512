"""P38, P21: callbacks make a helper at one place; what answers it makes another one."""
# live: no, no action type among the wheels

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node


class Asker:
    def __init__(self, node):
        self.node = node
        self.client = ActionClient(node, Fibonacci, 'count')

    def ask(self):
        future = self.client.send_goal_async(Fibonacci.Goal())
        future.add_done_callback(self.on_response)

    def on_response(self, future):
        self.node.ask()


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)
        self.create_timer(2.0, self.tock)

    def tick(self):
        self.ask()

    def tock(self):
        self.ask()

    def ask(self):
        Asker(self).ask()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()


# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer tick in a_default every 1
#     changes action_client @30>36>13
#     changes done_callback @30>36>17
#   timer tock in a_default every 2
#     changes action_client @33>36>13
#     changes done_callback @33>36>17
#   action_client count_action_client in a_default key=count conditional count=? when=callback
#   done_callback on_response in no_group key=count conditional when=callback
#     changes action_client @20>36>13
#     changes done_callback @20>36>17
#   ? count_action_client count
