"""P33: a library helper on a node that may be missing has its entities on that node."""
# live: no, the environment decides whether there is a node

import os

import rclpy
from rclpy.node import Node
from tf2_ros import Buffer, TransformListener


def make_node():
    if os.environ.get('ROBOT'):
        return Node('viewer')
    return None


def main():
    rclpy.init()
    node = make_node()
    listener = TransformListener(Buffer(), node)
    rclpy.spin(node)
    return listener


# expect:
# unit viewer: SingleThreadedExecutor x1 rclpy.spin, main
#   group tf REENTRANT library=tf2_ros.TransformListener
#   subscription tf_callback in tf key=/tf library=tf2_ros.TransformListener
#   subscription tf_static_callback in tf key=/tf_static library=tf2_ros.TransformListener
