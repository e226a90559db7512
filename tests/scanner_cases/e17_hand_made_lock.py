"""EffectLog: a class of the program that holds a lock; between its acquire and release, inside with."""

import threading

import rclpy
from rclpy.node import Node


class ReadWriteLock:
    def __init__(self):
        self.free = threading.Condition()
        self.readers = 0

    def acquire_read(self):
        with self.free:
            self.readers += 1

    def release_read(self):
        with self.free:
            self.readers -= 1
            self.free.notify_all()

    def acquire_write(self):
        self.free.acquire()
        while self.readers > 0:
            self.free.wait()

    def release_write(self):
        self.free.release()


class Guard:
    def __init__(self):
        self.inner = threading.Lock()

    def __enter__(self):
        self.inner.acquire()

    def __exit__(self, *exc):
        self.inner.release()


class Door:
    def acquire(self):
        pass

    def release(self):
        pass


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.rw = ReadWriteLock()
        self.guard = Guard()
        self.door = Door()
        self.value = 0
        self.create_timer(1.0, self.read)
        self.create_timer(1.0, self.write)
        self.create_timer(1.0, self.guarded)

    def read(self):
        self.rw.acquire_read()
        print(self.value)
        self.seen = True
        self.rw.release_read()
        print(self.value)

    def write(self):
        self.rw.acquire_write()
        self.value = 1
        self.rw.release_write()
        self.value = 2

    def guarded(self):
        with self.guard:
            self.value = 3
        self.door.acquire()
        self.value = 4
        self.door.release()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()


# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer read in a_default every 1
#     reads A.rw @63
#     reads A.value under rw (shared) @64
#     reads A.rw under rw (shared) @66
#     reads A.value @67
#     writes ReadWriteLock.readers update under free @63>16
#     writes A.seen under rw (shared) @65
#     writes ReadWriteLock.readers update under rw (shared), free @66>20
#     locks free @63>15
#     locks free @66>19
#   timer write in a_default every 1
#     blocks Condition.wait on read through free each conditional @70>26
#       ended by read @21
#     reads A.rw @70
#     reads ReadWriteLock.readers under free @70>25
#     reads A.rw under free, rw @72
#     writes A.value under free, rw @71
#     writes A.value @73
#     locks free @70>24
#   timer guarded in a_default every 1
#     reads A.guard @76
#     reads A.door @78
#     reads A.door @80
#     writes A.value under inner, guard @77
#     writes A.value @79
#     locks inner @76>37
