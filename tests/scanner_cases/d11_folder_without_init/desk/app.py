import rclpy
from desk.parts.lamp import Lamp
from rclpy.node import Node


def main():
    rclpy.init()
    node = Node('desk')
    Lamp(node)
    rclpy.spin(node)
