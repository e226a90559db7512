"""EffectLog: which locks are held over a wait; a condition gives its own back, a try is none."""

import threading
import time

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.lock = threading.Lock()
        self.again = threading.RLock()
        self.filled = threading.Condition()
        self.slots = threading.Semaphore(2)
        self.client = self.create_client(Trigger, 'plan')
        self.create_timer(1.0, self.ask)
        self.create_timer(1.0, self.queue)
        self.create_timer(1.0, self.attempt)

    def ask(self):
        with self.lock, self.again:
            self.client.call(Trigger.Request())
        time.sleep(0.1)

    def queue(self):
        with self.lock:
            with self.filled:
                self.filled.wait()
                time.sleep(0.1)

    def attempt(self):
        with self.slots:
            if self.lock.acquire(timeout=1.0):
                time.sleep(0.2)
                self.lock.release()


def main():
    rclpy.init()
    rclpy.spin(Arm())


if __name__ == '__main__':
    main()

# expect:
# unit arm: SingleThreadedExecutor x1 rclpy.spin, main
#   group arm_default EXCLUSIVE default
#   timer ask in arm_default every 1
#     blocks client.call on plan_client holding lock, again (re-entrant) @25
#     blocks time.sleep 0.1 s @26
#     locks lock @24
#     locks again holding lock @24
#   timer queue in arm_default every 1
#     blocks Condition.wait on filled each holding lock @31
#     blocks time.sleep 0.1 s holding lock, filled (re-entrant) @32
#     locks lock @29
#     locks filled holding lock @30
#   timer attempt in arm_default every 1
#     blocks time.sleep conditional 0.2 s @37
#     locks slots @35
#     locks lock tries @36
#   client plan_client in arm_default key=plan
