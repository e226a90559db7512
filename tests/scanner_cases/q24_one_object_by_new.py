"""Point 24: a ``__new__`` that gives what the class made before makes no other node."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Robot(Node):
    _made = None

    def __new__(cls):
        if cls._made is None:
            cls._made = super().__new__(cls)
            cls._made.is_ready = False
        return cls._made

    def __init__(self):
        if self.is_ready:
            return
        self.is_ready = True
        super().__init__('robot')
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


class Lidar:
    _lock = threading.Lock()

    def __new__(cls, name):
        with cls._lock:
            if not hasattr(cls, '_made'):
                cls._made = object.__new__(cls)
                cls._made.node = Node(name)
                cls._made.node.create_timer(0.1, cls._made.turn)
        return cls._made

    def turn(self):
        pass


class Wheel(Node):
    _made = {}

    def __new__(cls, name):
        if name not in cls._made:
            cls._made[name] = super(Wheel, cls).__new__(cls)
            Node.__init__(cls._made[name], name)
            cls._made[name].create_timer(0.2, cls._made[name].roll)
        return cls._made[name]

    def __init__(self, name):
        pass

    def roll(self):
        pass


class Tools:
    _made = None

    @classmethod
    def given(cls, node):
        if cls._made is None:
            cls._made = cls.__new__(cls)
            cls._made.__init__(node)
        return cls._made

    def __init__(self, node):
        self.node = node

    @classmethod
    def every(cls, seconds, work):
        return cls._made.node.create_timer(seconds, work)


def work():
    pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (Robot(), Robot(), Lidar('lidar').node, Lidar('other').node):
        executor.add_node(node)
    for name in ('left', 'right', 'left'):
        executor.add_node(Wheel(name))
    Tools.given(Robot())
    Tools.every(3.0, work)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit robot_and_3_more: MultiThreadedExecutor x4 spin, main
#   nodes robot, lidar, left, right
#   group robot_default EXCLUSIVE default
#   group lidar_default EXCLUSIVE default
#   group left_default EXCLUSIVE default
#   group right_default EXCLUSIVE default
#   timer tick in robot_default every 1 node=robot
#   timer work in robot_default every 3 node=robot
#   timer turn in lidar_default every 0.1 node=lidar
#   timer left_roll in left_default (Wheel.roll) every 0.2 node=left
#   timer right_roll in right_default (Wheel.roll) every 0.2 node=right
