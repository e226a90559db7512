from rclpy.node import Node


class RobotBase(Node):
    pass
