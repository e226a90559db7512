"""P18: a class that has a node."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Robot:
    def __init__(self):
        self.node = Node('robot')
        self.node.create_subscription(String, 'in', self.on_in, 10)
        self.node.create_timer(0.5, self.tick)

    def on_in(self, msg):
        pass

    def tick(self):
        pass


def main():
    rclpy.init()
    robot = Robot()
    rclpy.spin(robot.node)


if __name__ == '__main__':
    main()

# expect:
# unit robot: SingleThreadedExecutor x1 rclpy.spin, main
#   group robot_default EXCLUSIVE default
#   timer tick in robot_default every 0.5
#   subscription on_in in robot_default key=in
