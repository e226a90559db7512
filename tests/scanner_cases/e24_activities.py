"""EffectLog: threads, pools and timers of a node's own, with what they wait for, read and write."""

import threading
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.latest = None
        self.changed = threading.Event()
        self.client = self.create_client(Trigger, 'go')
        self.publisher = self.create_publisher(String, 'out', 10)
        self.pool = ThreadPoolExecutor(2)
        threading.Thread(target=self.work, daemon=True).start()
        threading.Timer(5.0, self.late).start()
        self.create_subscription(String, 'in', self.on_in, 10)
        self.create_timer(1.0, self.ask)

    def work(self):
        while rclpy.ok():
            self.changed.wait()
            self.changed.clear()
            if self.latest is not None:
                self.publisher.publish(self.latest)

    def late(self):
        self.changed.set()

    def on_in(self, msg):
        self.latest = msg
        self.changed.set()

    def ask(self):
        future = self.pool.submit(self.client.call, Trigger.Request())
        future.result(timeout=2.0)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer ask in a_default every 1
#     blocks Future.result on future 2.0 s @41
#       ended by call @40
#   subscription on_in in a_default key=in
#     writes A.latest @36
#   client go_client in a_default key=go
#   activity thread work (A.work) daemon loops
#     blocks Event.wait on changed @27
#       ended by on_in @37
#       ended by late @33
#     reads A.latest @29
#     reads A.latest @30
#     publishes out after 1 conditional @30
#   activity timer late (A.late)
#   activity pool call started by ask @40 count=?
#     blocks client.call on go_client @40
