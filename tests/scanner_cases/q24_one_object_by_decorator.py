"""Point 24: a class behind a decorator that keeps its one object is one node."""

import functools

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


def singleton(cls):
    made = {}

    @functools.wraps(cls)
    def get(*args, **kwargs):
        if cls not in made:
            made[cls] = cls(*args, **kwargs)
        return made[cls]

    return get


class Single:
    def __init__(self, cls):
        self._cls = cls
        self._object = None

    def __call__(self, *args, **kwargs):
        if self._object is None:
            self._object = self._cls(*args, **kwargs)
        return self._object


@singleton
class Wheels(Node):
    def __init__(self):
        super().__init__('wheels')
        self.create_timer(0.1, self.turn)

    def turn(self):
        pass


@Single
class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        self.create_timer(1.0, self.blink)

    def blink(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (Wheels(), Wheels(), Lamp(), Lamp()):
        executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit wheels_and_lamp: MultiThreadedExecutor x4 spin, main
#   nodes wheels, lamp
#   group wheels_default EXCLUSIVE default
#   group lamp_default EXCLUSIVE default
#   timer turn in wheels_default every 0.1 node=wheels
#   timer blink in lamp_default every 1 node=lamp
