"""EffectLog: a loop that is unrolled does the same at one place; other targets count apart."""

import threading
import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.lock = threading.Lock()
        self.out = self.create_publisher(String, 'out', 10)
        group = ReentrantCallbackGroup()
        self.arm = self.create_client(Trigger, 'arm', callback_group=group)
        self.base = self.create_client(Trigger, 'base', callback_group=group)
        self.create_timer(1.0, self.tick)

    def tick(self):
        for count in range(4):
            time.sleep(0.1)
            with self.lock:
                self.out.publish(String())
            self.create_timer(1.0, print)
        for client in (self.arm, self.base):
            client.call(Trigger.Request())


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group REENTRANT
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks time.sleep 0.1 s 4 times @25
#     blocks client.call on arm_client @30
#     blocks client.call on base_client @30
#     locks lock @26
#     publishes out after 1 @27
#     changes timer @28
#   timer print in a_default every 1 conditional count=? when=callback
#   client arm_client in group key=arm
#   client base_client in group key=base
#   ? print count
