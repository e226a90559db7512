"""Point 12: branches of a callback: it may take one now and another when it runs again."""
# live: no, the topics decide

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.create_subscription(String, 'mode', self.on_mode, 10)
        if self.declare_parameter('arm', True).value:
            self.create_subscription(String, 'arm', self.on_arm, 10)
        else:
            self.create_timer(1.0, self.tick)

    def on_mode(self, msg):
        if msg.data == 'slow':
            self.create_timer(1.0, self.tick)
        else:
            self.create_timer(0.1, self.tick)

    def on_arm(self, msg):
        pass

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Robot())


if __name__ == '__main__':
    main()

# expect:
# unit robot: SingleThreadedExecutor x1 rclpy.spin, main
#   group robot_default EXCLUSIVE default
#   timer tick in robot_default every 1 conditional alternative@13.1
#   timer tick_2 in robot_default (Robot.tick) every 1 conditional count=? when=callback
#   timer tick_3 in robot_default (Robot.tick) every 0.1 conditional count=? when=callback
#   subscription on_mode in robot_default key=mode
#     changes timer @20
#     changes timer @22
#   subscription on_arm in robot_default key=arm conditional alternative@13.0
#   ? tick_2 count
#   ? tick_3 count
