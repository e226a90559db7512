"""P57: a registry that Python keeps: all subclasses, each made once, their node set from outside."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Module:
    def __init__(self, name):
        self.name = name


class Arm(Module):
    def __init__(self):
        super().__init__('arm')

    def activate(self):
        self.robot.create_subscription(String, 'arm', self.on_arm, 10)

    def on_arm(self, msg):
        pass


class Gripper(Arm):
    def activate(self):
        self.robot.create_timer(1.0, self.close)

    def close(self):
        self.robot.arm.on_arm(None)


def all_subclasses(cls):
    return cls.__subclasses__() + [
        below for each in cls.__subclasses__() for below in all_subclasses(each)
    ]


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.modules = [cls() for cls in all_subclasses(Module)]
        for module in self.modules:
            module.robot = self
            self.__setattr__(module.name, module)
        for module in self.modules:
            module.activate()


def main():
    rclpy.init()
    rclpy.spin(Robot())


# expect:
# unit robot: SingleThreadedExecutor x1 rclpy.spin, main
#   group robot_default EXCLUSIVE default
#   timer close in robot_default every 1
#     reads Robot.arm @29
#   subscription on_arm in robot_default key=arm
