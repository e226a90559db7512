"""B1: waits forever when the button is pressed; the wait stands two helpers away."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        self.client = self.create_client(Trigger, 'shut_down_motors')
        self.create_subscription(String, 'switch', self.on_switch, 10)

    def on_switch(self, msg):
        if msg.data == 'off':
            self.shut_down()

    def shut_down(self):
        return self.wait_for(self.client.call_async(Trigger.Request()))

    def wait_for(self, future):
        while not future.done():
            time.sleep(0.1)
        return future.result()


def main():
    rclpy.init()
    rclpy.spin(Camera())


if __name__ == '__main__':
    main()

# finds: CC102:25
