"""B1: waits forever when the button is pressed; the wait stands two helpers away. Mended."""

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
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_done)

    def on_done(self, future):
        self.get_logger().info(future.result().message)


def main():
    rclpy.init()
    rclpy.spin(Camera())


if __name__ == '__main__':
    main()

# finds: nothing
