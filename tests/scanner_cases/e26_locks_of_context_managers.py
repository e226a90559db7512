"""EffectLog: a lock held by a ``@contextmanager`` of one's own, in helpers of it, and on an exit stack."""

import threading
from contextlib import ExitStack, contextmanager

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.lock = threading.Lock()
        self.other = threading.Lock()
        self.value = 0
        self.create_timer(1.0, self.by_generator)
        self.create_timer(1.0, self.by_two)
        self.create_timer(1.0, self.by_stack)
        self.create_timer(1.0, self.before_and_after)

    @contextmanager
    def guarded(self):
        with self.lock:
            yield self.value

    @contextmanager
    def doubly_guarded(self):
        with self.guarded():
            self.other.acquire()
            try:
                yield
            finally:
                self.other.release()

    @contextmanager
    def let_go_first(self):
        with self.lock:
            pass
        yield

    def by_generator(self):
        with self.guarded():
            self.value = 1
        self.value = 2

    def by_two(self):
        with self.doubly_guarded():
            self.value = 3
        with self.let_go_first():
            self.value = 4

    def by_stack(self):
        with ExitStack() as stack:
            self.value = 5
            stack.enter_context(self.other)
            stack.enter_context(self.guarded())
            self.value = 6
        self.value = 7

    def before_and_after(self):
        with self.guarded() as before:
            pass
        self.value = before + 1


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer by_generator in a_default every 1
#     reads A.value under lock @42>24
#     writes A.value under lock @43
#     writes A.value @44
#     locks lock @42>23
#   timer by_two in a_default every 1
#     reads A.value under lock @47>28>24
#     writes A.value under lock, other @48
#     writes A.value @50
#     locks lock @47>28>23
#     locks other holding lock @47>29
#     locks lock @49>37
#   timer by_stack in a_default every 1
#     reads A.value under other, lock @56>24
#     writes A.value @54
#     writes A.value under other, lock @57
#     writes A.value @58
#     locks other @55
#     locks lock holding other @56>23
#   timer before_and_after in a_default every 1
#     reads A.value under lock @61>24
#     writes A.value @63
#     locks lock @61>23
