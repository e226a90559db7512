"""Point 26: a method that only a later method calls has a known caller."""
# live: no, nothing calls the methods

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Tester(Node):
    def __init__(self):
        super().__init__('tester')

    def wait_for(self, name):
        self.client = self.create_client(Trigger, f'{name}/ready')

    def listen(self, topic):
        self.create_subscription(String, topic, self.on_message, 10)

    def on_message(self, msg):
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass

    def check(self):
        self.wait_for('arm')
        self.wait_for('base')

    def begin(self):
        self.check()
        self.listen('done')


def main():
    rclpy.init()
    rclpy.spin(Tester())


if __name__ == '__main__':
    main()

# expect:
# unit tester: SingleThreadedExecutor x1 rclpy.spin, main
#   group tester_default EXCLUSIVE default
#   timer tick in tester_default every 1 conditional count=? when=callback
#   subscription on_message in tester_default key=done conditional when=later
#     changes timer @21
#   client arm_ready_client in tester_default key=arm/ready conditional when=later
#   client base_ready_client in tester_default key=base/ready conditional when=later
#   ? tick count
