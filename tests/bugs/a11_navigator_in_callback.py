"""A11: a callback asks the navigator, which spins inside."""

import rclpy
from geometry_msgs.msg import PoseStamped
from nav2_simple_commander.robot_navigator import BasicNavigator
from rclpy.node import Node


class Patrol(Node):
    def __init__(self):
        super().__init__('patrol')
        self.navigator = BasicNavigator()
        self.create_subscription(PoseStamped, 'start', self.on_start, 10)

    def on_start(self, msg):
        self.navigator.goToPose(msg)
        while not self.navigator.isTaskComplete():
            pass


def main():
    rclpy.init()
    rclpy.spin(Patrol())


if __name__ == '__main__':
    main()

# finds: CC107:16 warning, CC107:17 warning
