"""Asks for a plan and goes on when it comes."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.plan = self.create_client(Trigger, 'plan')
        self.said = self.create_publisher(String, 'said', 10)
        self.create_timer(0.2, self.tick)

    def tick(self):
        self.plan.call_async(Trigger.Request())


def main():
    rclpy.init()
    rclpy.spin(Asker())


if __name__ == '__main__':
    main()
