"""A11: the callback keeps the goal; the main loop asks the navigator."""

import rclpy
from geometry_msgs.msg import PoseStamped
from nav2_simple_commander.robot_navigator import BasicNavigator
from rclpy.node import Node


class Patrol(Node):
    def __init__(self):
        super().__init__('patrol')
        self.goal = None
        self.create_subscription(PoseStamped, 'start', self.on_start, 10)

    def on_start(self, msg):
        self.goal = msg


def main():
    rclpy.init()
    node, navigator = Patrol(), BasicNavigator()
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0.1)
        if node.goal is not None and navigator.isTaskComplete():
            navigator.goToPose(node.goal)


if __name__ == '__main__':
    main()

# finds: nothing
