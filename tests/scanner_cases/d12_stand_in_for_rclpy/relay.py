import rclpy
from rclpy.node import Node
from std_msgs.msg import String


def relay(topics):
    rclpy.init()
    node = Node('relay')
    for topic in topics:
        node.create_subscription(String, topic, print, 10)
    rclpy.spin(node)
    return node


def main():
    relay(['a'])
