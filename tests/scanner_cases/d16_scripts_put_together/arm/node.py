import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def fast():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Arm())
    executor.spin()


def ros_main():
    rclpy.init()
    rclpy.spin(Arm())


def main():
    """No script of the package starts here."""
    ros_main()
