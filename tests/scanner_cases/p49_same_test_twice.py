"""P49: two ``if`` ask the same; what their opposite arms make excludes each other."""

import sys

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self, by_tf=False):
        super().__init__('a')
        self.by_tf = by_tf or self.declare_parameter('by_tf', False).value
        self.source = self.declare_parameter('source', '').value
        self.pose = None
        self.goal = None
        free = ReentrantCallbackGroup()
        if not self.by_tf:
            self.create_subscription(String, 'pose', self.on_pose, 10, callback_group=free)
        if self.by_tf:
            self.create_timer(0.1, self.look_up, free)
        else:
            self.create_subscription(String, 'goal', self.on_goal, 10, callback_group=free)
        if self.source is None:
            self.create_timer(1.0, self.guess, free)
        self.source = self.declare_parameter('other', '').value
        if self.source is not None:
            self.create_timer(2.0, self.ask, free)

    def on_pose(self, msg):
        self.pose = msg

    def look_up(self):
        if self.pose is None:
            self.pose = self.goal

    def on_goal(self, msg):
        self.goal = msg

    def guess(self):
        pass

    def ask(self):
        pass

    def nobody_in_sight_calls(self, by_tf):
        if by_tf:
            self.create_timer(3.0, self.ask_again)
        if not by_tf:
            self.create_timer(3.0, self.guess_again)

    def ask_again(self):
        pass

    def guess_again(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(2)
    executor.add_node(A(by_tf=len(sys.argv) > 1))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group free REENTRANT
#   group a_default EXCLUSIVE default
#   timer look_up in free every 0.1 conditional alternative@20.1
#     reads A.pose @36
#     reads A.goal @37
#     writes A.pose rests @37
#   timer guess in free every 1 conditional
#   timer ask in free every 2 conditional
#   timer ask_again in a_default every 3 conditional when=later
#   timer guess_again in a_default every 3 conditional when=later
#   subscription on_pose in free key=pose conditional alternative@20.0
#     writes A.pose @33
#   subscription on_goal in free key=goal conditional alternative@20.0
#     writes A.goal @40
