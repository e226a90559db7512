"""EffectLog: an item under an index or a key that changes is one of the objects that are there."""

import time

import rclpy
from rclpy.node import Node


class Leaf:
    def __init__(self):
        self.done = False

    def tick(self):
        while not self.done:
            time.sleep(0.1)


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.first, self.second = Leaf(), Leaf()
        self.leaves = [self.first, self.second]
        self.by_name = {'first': self.first, 'second': self.second}
        self.index = 0
        self.name = self.declare_parameter('name', 'first').value
        self.create_timer(1.0, self.by_index)
        self.create_timer(1.0, self.by_key)
        self.create_timer(1.0, self.end)

    def by_index(self):
        while self.index < len(self.leaves):
            self.leaves[self.index].tick()
            self.index += 1

    def by_key(self):
        self.by_name[self.name].tick()

    def end(self):
        self.first.done = True


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer by_index in a_default every 1
#     blocks time.sleep conditional 0.1 s @32>15
#     blocks polling loop on end through Leaf.done conditional @32>14
#       ended by end @39
#     blocks polling loop on Leaf#2.done conditional @32>14
#     reads A.index @31
#     reads A.leaves @31
#     reads A.leaves @32
#     reads A.index @32
#     reads Leaf.done @32>14
#     reads Leaf#2.done @32>14
#     writes A.index update @33
#   timer by_key in a_default every 1
#     blocks time.sleep conditional 0.1 s @36>15
#     blocks polling loop on end through Leaf.done conditional @36>14
#       ended by end @39
#     blocks polling loop on Leaf#2.done conditional @36>14
#     reads A.by_name @36
#     reads A.name @36
#     reads Leaf.done @36>14
#     reads Leaf#2.done @36>14
#   timer end in a_default every 1
#     reads A.first @39
#     writes Leaf.done @39
