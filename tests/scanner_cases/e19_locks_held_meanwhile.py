"""EffectLog: what is held while a lock is taken; two locks of one name; branches that give it back."""

import threading

import rclpy
from rclpy.node import Node


class Store:
    def __init__(self):
        self.lock = threading.Lock()
        self.number = 0

    def count(self):
        with self.lock:
            self.number += 1


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.lock = threading.Lock()
        self.again = threading.RLock()
        self.store, self.value = Store(), 0
        self.create_timer(1.0, self.nested)
        self.create_timer(1.0, self.in_branches)
        self.create_timer(1.0, self.in_handler)

    def nested(self):
        with self.lock:
            self.store.count()
        with self.again, self.again:
            self.look()
        with self.again:
            self.lock.acquire(timeout=1.0)

    def look(self):
        with self.lock:
            with self.lock:
                pass

    def in_branches(self):
        self.lock.acquire()
        if not rclpy.ok():
            self.lock.release()
            return
        self.value = 1
        self.lock.release()
        self.value = 2

    def in_handler(self):
        try:
            self.lock.acquire()
            self.value = 3
            self.lock.release()
        except ValueError:
            self.value = 4
            self.lock.release()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer nested in a_default every 1
#     reads A.store under lock @31
#     writes Store.number update under lock, lock#2 @31>16
#     locks lock @30
#     locks lock#2 holding lock @31>15
#     locks again @32
#     locks lock holding again @33>38
#     locks lock holding again, lock @33>39
#     locks again @34
#     locks lock tries @35
#   timer in_branches in a_default every 1
#     writes A.value under lock @47
#     writes A.value @49
#     locks lock @43
#   timer in_handler in a_default every 1
#     writes A.value under lock @54
#     writes A.value under lock @57
#     locks lock @53
