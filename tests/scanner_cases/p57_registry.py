"""P57: classes out of a registry, by a name that is not known: one of all that are in it."""
# live: no, the parameter decides

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

DRIVERS = {}


def driver(name):
    def keep(cls):
        DRIVERS[name] = cls
        return cls

    return keep


@driver('camera')
class Camera:
    def open(self, node):
        node.create_subscription(String, 'image', self.on_image, 10)

    def on_image(self, msg):
        pass


@driver('lidar')
class Lidar:
    def open(self, node):
        node.create_subscription(String, 'scan', self.on_scan, 10)

    def on_scan(self, msg):
        pass


@driver('none')
class Nothing:
    def open(self, node):
        pass


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        kind = self.declare_parameter('driver', 'camera').value
        self.driver = DRIVERS[kind]()
        self.driver.open(self)
        self.second = DRIVERS.get(kind, Nothing)()
        self.second.open(self)


def main():
    rclpy.init()
    rclpy.spin(Robot())

# expect:
# unit robot: SingleThreadedExecutor x1 rclpy.spin, main
#   group robot_default EXCLUSIVE default
#   subscription image_on_image in robot_default (Camera.on_image) key=image conditional alternative@48.0
#   subscription scan_on_scan in robot_default (Lidar.on_scan) key=scan conditional alternative@48.1
#   subscription image_on_image_2 in robot_default (Camera.on_image) key=image conditional alternative@50.0
#   subscription scan_on_scan_2 in robot_default (Lidar.on_scan) key=scan conditional alternative@50.1
