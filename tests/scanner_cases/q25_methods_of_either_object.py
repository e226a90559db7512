"""Point 25: an object is built in both arms of an ``if``; its methods are one function each."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Arm:
    def __init__(self, node, speed=0.1):
        self.client = node.create_client(Trigger, 'home')
        self.speed = speed

    def on_goal(self, msg):
        self.client.call(Trigger.Request())

    def on_stop(self, msg):
        pass


class Gripper:
    def on_stop(self, msg):
        pass


def main():
    rclpy.init()
    node = Node('arm')
    speed = node.declare_parameter('speed', 0.0).value
    if speed:
        arm = Arm(node, speed)
    else:
        arm = Arm(node)
    stopped = arm if speed else Gripper()
    node.create_subscription(String, 'goal', arm.on_goal, 10)
    node.create_subscription(String, 'stop', stopped.on_stop, 10)
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit arm: SingleThreadedExecutor x1 rclpy.spin, main
#   group arm_default EXCLUSIVE default
#   subscription on_goal in arm_default key=goal
#     blocks client.call on home_home_client @15
#     blocks client.call on home_home_client_2 @15
#   subscription on_stop in arm_default key=stop UNRESOLVED
#   client home_home_client in arm_default key=home conditional alternative@30.0
#   client home_home_client_2 in arm_default key=home conditional alternative@30.1
#   ? on_stop function
