"""A callback that raises: the program ends with its traceback."""

import rclpy


def tick() -> None:
    raise RuntimeError('the arm is stuck')


rclpy.init()
node = rclpy.create_node('stuck')
node.create_timer(0.01, tick)
rclpy.spin(node)
