"""EffectLog: which reads of a goal callback decide whether a goal is let in."""

import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.node import Node
from test_msgs.action import Fibonacci


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.running = 0
        self.seen = 0
        self.free = True
        ActionServer(self, Fibonacci, 'f', self.execute, goal_callback=self.on_goal)
        ActionServer(self, Fibonacci, 'g', self.execute, goal_callback=self.on_other)

    def on_goal(self, request):
        self.get_logger().info('%d seen' % self.seen)
        if self.running >= 2:
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def on_other(self, request):
        return GoalResponse.ACCEPT if self.free else GoalResponse.REJECT

    def execute(self, goal_handle):
        self.running += 1
        self.seen += 1
        self.free = False
        goal_handle.succeed()
        self.free = True
        self.running -= 1
        return Fibonacci.Result()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   action_server f_action_server in a_default (A.on_goal) key=f
#     reads A.seen @19
#     reads A.running admits @20
#   action_server g_action_server in a_default (A.on_other) key=g
#     reads A.free admits @25
#   action_execute f_execute in no_group (A.execute) key=f
#     writes A.running update @28
#     writes A.seen update @29
#     writes A.free @30
#     writes A.free @32
#     writes A.running update @33
#   action_execute g_execute in no_group (A.execute) key=g
#     writes A.running update @28
#     writes A.seen update @29
#     writes A.free @30
#     writes A.free @32
#     writes A.running update @33
