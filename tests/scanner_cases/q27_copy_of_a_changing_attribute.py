"""Point 12: a test on a local copy of what other callbacks change is as open as the original."""
# live: no, the topics decide

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.mode = 'idle'
        self.alarm = self.create_timer(1.0, self.ring)
        self.create_subscription(String, 'go', self.on_go, 10)
        self.create_subscription(String, 'stop', self.on_stop, 10)
        self.create_subscription(String, 'mode', self.on_mode, 10)

    def on_mode(self, msg):
        self.mode = msg.data
        self.alarm = None

    def on_go(self, msg):
        mode = self.mode
        if mode != 'idle':
            self.create_timer(0.5, self.drive)
        mode = 'idle'
        if mode != 'idle':
            self.create_timer(0.25, self.drive)

    def on_stop(self, msg):
        alarm = self.alarm
        if alarm is None:
            alarm = self.create_timer(2.0, self.ring)
        alarm.reset()

    def ring(self):
        pass

    def drive(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Robot())


if __name__ == '__main__':
    main()

# expect:
# unit robot: SingleThreadedExecutor x1 rclpy.spin, main
#   group robot_default EXCLUSIVE default
#   timer ring in robot_default every 1
#   timer drive in robot_default every 0.5 conditional count=? when=callback
#   timer ring_2 in robot_default (Robot.ring) every 2 conditional count=? when=callback
#   subscription on_go in robot_default key=go
#     reads Robot.mode @23
#     changes timer @25
#   subscription on_stop in robot_default key=stop
#     reads Robot.alarm @31
#     changes timer @33
#   subscription on_mode in robot_default key=mode
#     writes Robot.mode @19
#     writes Robot.alarm clears @20
#   ? drive count
#   ? ring_2 count
