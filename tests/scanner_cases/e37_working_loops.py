"""E37: a loop in which a thread works waits for nobody; one that only sleeps does."""

import threading
import time

import rclpy
from rclpy.node import Node


class Press(Node):
    def __init__(self):
        super().__init__('press')
        self.running = True
        self.ready = False
        self.stop = threading.Event()
        threading.Thread(target=self.work, daemon=True).start()
        threading.Thread(target=self.watch, daemon=True).start()
        threading.Thread(target=self.wait, daemon=True).start()
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.get_logger().info('x')

    def work(self):
        while self.running:
            self.tick()
            time.sleep(0.1)

    def watch(self):
        while not self.stop.is_set():
            self.tick()
            time.sleep(0.1)

    def wait(self):
        while not self.ready:
            time.sleep(0.1)


def main():
    rclpy.init()
    rclpy.spin(Press())


if __name__ == '__main__':
    main()


# expect:
# unit press: SingleThreadedExecutor x1 rclpy.spin, main
#   group press_default EXCLUSIVE default
#   timer tick in press_default every 1
#   activity thread work (Press.work) daemon loops
#     blocks time.sleep 0.1 s @27
#     reads Press.running @25
#   activity thread watch (Press.watch) daemon loops
#     blocks time.sleep 0.1 s @32
#   activity thread wait (Press.wait) daemon
#     blocks time.sleep 0.1 s @36
#     blocks polling loop on Press.ready @35
#     reads Press.ready @35
