import rclpy
from rclpy.node import Node


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def serve(node_class):
    def run():
        rclpy.init()
        rclpy.spin(node_class())

    return run
