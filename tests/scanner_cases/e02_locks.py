"""EffectLog: locks held by with, by acquire and release, nested."""

import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.lock = threading.Lock()
        self.other = threading.RLock()
        self.value = 0
        self.create_timer(1.0, self.tick)
        self.create_subscription(String, 'in', self.on_in, 10)

    def tick(self):
        with self.lock:
            self.value += 1
            with self.other:
                self.value = 0
        print(self.value)

    def on_in(self, msg):
        self.lock.acquire()
        self.value = 1
        self.lock.release()
        self.value = 2


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     reads A.value @24
#     writes A.value update under lock @21
#     writes A.value under lock, other @23
#     locks lock @20
#     locks other holding lock @22
#   subscription on_in in a_default key=in
#     writes A.value under lock @28
#     writes A.value @30
#     locks lock @27
