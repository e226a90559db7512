"""B1: the joystick node hangs; a nested spin waits for a client of the group it keeps closed."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Joystick(Node):
    def __init__(self):
        super().__init__('joystick')
        self.client = self.create_client(Trigger, 'shut_down_motors')
        self.create_subscription(String, 'joy', self.on_joy, 10)

    def on_joy(self, msg):
        if msg.data == 'off':
            self.shut_down()

    def shut_down(self):
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)


def main():
    rclpy.init()
    rclpy.spin(Joystick())


if __name__ == '__main__':
    main()

# finds: CC101:21, CC106:21 warning
