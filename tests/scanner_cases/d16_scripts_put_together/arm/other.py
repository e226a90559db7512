import rclpy

from arm.node import Arm


def ros_main():
    rclpy.init()
    node = Arm()
    node.create_timer(0.25, node.tick)
    rclpy.spin(node)
