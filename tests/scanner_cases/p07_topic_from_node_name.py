"""P07: topics that follow from the name of the node, which may be renamed when it is started."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self, name='arm'):
        super().__init__(name)
        self.create_subscription(String, f'{self.get_name()}/goal', self.on_goal, 10)
        self.create_service(Trigger, self.get_name() + '/stop', self.on_stop)

    def on_goal(self, msg):
        pass

    def on_stop(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Arm())


if __name__ == '__main__':
    main()

# expect:
# unit arm: SingleThreadedExecutor x1 rclpy.spin, main
#   group arm_default EXCLUSIVE default
#   subscription on_goal in arm_default key=arm/goal ASSUMED
#   service on_stop in arm_default key=arm/stop ASSUMED
