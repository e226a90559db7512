import arm.nodes
import rclpy


def main():
    rclpy.init()
    rclpy.spin(arm.nodes.A())
