"""EffectLog: ``setattr`` stores, a handler of a signal ends loops, ``ord`` and ``chr`` are known."""

import signal
import threading
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

running = True


def stop(number, frame):
    global running
    running = False


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.latest = None
        self.lock = threading.Lock()
        self.create_subscription(String, 'x', lambda msg: setattr(self, 'latest', msg), 10)
        self.create_subscription(String, 'y', self.on_move, 10)

    def on_move(self, msg):
        self.send(ord('M'))

    def send(self, number):
        with self.lock:
            if chr(number) not in ('M', 'G'):
                self.tell()

    def tell(self):
        with self.lock:
            self.get_logger().info('told')


def main():
    signal.signal(signal.SIGINT, stop)
    rclpy.init()
    node = A()
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    while node.latest is None:
        time.sleep(0.1)
    while running:
        time.sleep(0.1)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin in thread, main
#   group a_default EXCLUSIVE default
#   subscription lambda_setattr in a_default (A.__init__.<locals>.<lambda>) key=x
#     writes A.latest @24
#   subscription on_move in a_default key=y
#     locks lock @28>31
#   activity main main
#     blocks time.sleep 0.1 s @46
#     blocks polling loop on lambda_setattr through A.latest @45
#       ended by lambda_setattr @24
#     blocks time.sleep 0.1 s @48
#     blocks polling loop on e38_signals_and_setattr.running @47
#       ended by outside @16
#     reads A.latest @45
#     reads e38_signals_and_setattr.running @47
