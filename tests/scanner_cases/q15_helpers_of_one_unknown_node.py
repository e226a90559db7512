"""Point 15: objects that were given the same unknown node make one entity of unknown count."""
# live: no, nobody calls grow

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class Behaviour:
    def setup(self, **kwargs):
        self.node = kwargs['node']
        group = MutuallyExclusiveCallbackGroup()
        self.node.create_subscription(String, 'goal', self.on_goal, 10, callback_group=group)
        self.node.create_timer(1.0, self.tick)

    def on_goal(self, msg):
        self.goal = msg

    def tick(self):
        pass


class Tree(Node):
    def __init__(self):
        super().__init__('tree')
        self.first = Behaviour()
        self.second = Behaviour()
        self.create_timer(2.0, self.beat)

    def grow(self, **kwargs):
        self.first.setup(**kwargs)
        self.second.setup(**kwargs)

    def beat(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Tree())

# expect:
# unit tree: SingleThreadedExecutor x1 rclpy.spin, main
#   group tree_default EXCLUSIVE default
#   timer beat in tree_default every 2
# unit kwargs_node: no executor, main
#   group group EXCLUSIVE
#   group kwargs_node_default EXCLUSIVE default
#   timer tick in kwargs_node_default every 1 node=? conditional count=? when=later
#   subscription on_goal in group key=goal node=? conditional count=? when=later
#     writes Behaviour.goal @18
#   ? tick node
#   ? tick count
#   ? on_goal node
#   ? on_goal count
#   ? executor executor
