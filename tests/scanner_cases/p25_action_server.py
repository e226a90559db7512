"""P25: server callbacks in its group, the execute callback in none."""
# live: no, no action type among the wheels

import time

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.group = MutuallyExclusiveCallbackGroup()
        self.server = ActionServer(
            self,
            Fibonacci,
            'fibonacci',
            execute_callback=self.execute,
            goal_callback=self.on_goal,
            cancel_callback=self.on_cancel,
            callback_group=self.group,
        )
        self.create_timer(0.5, self.tick, callback_group=self.group)

    def execute(self, handle):
        time.sleep(1.0)
        return Fibonacci.Result()

    def on_goal(self, request):
        pass

    def on_cancel(self, handle):
        pass

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group EXCLUSIVE
#   group no_group REENTRANT groupless
#   timer tick in group every 0.5
#   action_server fibonacci_action_server in group (A.on_goal) key=fibonacci
#   action_execute execute in no_group key=fibonacci
#     blocks time.sleep 1.0 s @29
