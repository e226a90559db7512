"""EffectLog: a module, class or function in a global is no shared data."""

import os

import rclpy
from rclpy.node import Node

if os.name == 'posix':
    import shutil
else:
    shutil = None


class Table:
    rows = []


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)

    def tick(self):
        os.remove('x')
        shutil.copy('a', 'b')
        if rclpy.ok():
            Table.update()


def main():
    global os
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
