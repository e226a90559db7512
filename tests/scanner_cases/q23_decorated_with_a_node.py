"""Point 23: a decorator that makes the node: what it decorates gets that one, no other."""
# live: no, nobody calls the methods

import functools

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


def with_node(method):
    @functools.wraps(method)
    def run(self):
        node = Node(method.__name__)
        method(self, node)
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        executor.spin()

    return run


def unknown_decorator(method):
    return REGISTRY.add(method)


class Trials:
    @with_node
    def first(self, node):
        node.create_subscription(String, 'one', self.on_msg, 10)

    @with_node
    def second(self, node):
        node.create_subscription(String, 'two', self.on_msg, 10)

    @unknown_decorator
    def third(self, node):
        node.create_subscription(String, 'three', self.on_msg, 10)

    def on_msg(self, msg):
        pass

# expect:
# unit first: SingleThreadedExecutor x1 spin
#   group first_default EXCLUSIVE default
#   subscription on_msg in first_default key=one when=later
# unit second: SingleThreadedExecutor x1 spin
#   group second_default EXCLUSIVE default
#   subscription on_msg in second_default key=two when=later
# unit node: no executor
#   group node_default EXCLUSIVE default
#   subscription on_msg in node_default key=three node=? conditional when=later
#   ? on_msg node
#   ? executor executor
