"""A thread that a module starts spins its executor once, no matter what follows the module."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        self.create_timer(1.0, self.look)

    def look(self):
        pass


def spin():
    executor.spin()


rclpy.init()
camera = Camera()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(camera)
threading.Thread(target=spin, daemon=True).start()

# expect:
# unit camera: MultiThreadedExecutor x2 spin in thread, __main__
#   group camera_default EXCLUSIVE default
#   timer look in camera_default every 1
