"""Point 24: a metaclass whose ``__call__`` keeps what it made gives one object of each class."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class OneOfEach(type):
    _made = {}

    def __call__(cls, *args, **kwargs):
        if cls not in cls._made:
            cls._made[cls] = super().__call__(*args, **kwargs)
        return cls._made[cls]


class Last(type):
    def __init__(cls, name, bases, names):
        super().__init__(name, bases, names)
        cls.last = None

    def __call__(cls, *args):
        if not hasattr(cls, '_made'):
            cls._made = type.__call__(cls, *args)
        return cls._made


class Arm(metaclass=OneOfEach):
    def __init__(self, name='arm'):
        self.node = Node(name)
        self.node.create_timer(1.0, self.move)

    def move(self):
        pass


class LeftArm(Arm):
    def __init__(self):
        super().__init__('left_arm')


class Gripper(metaclass=Last):
    def __init__(self):
        self.node = Node('gripper')
        self.node.create_timer(1.0, self.close)

    def close(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for part in (Arm(), LeftArm(), Arm(), LeftArm(), Gripper(), Gripper()):
        executor.add_node(part.node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit arm_and_2_more: MultiThreadedExecutor x4 spin, main
#   nodes arm, left_arm, gripper
#   group arm_default EXCLUSIVE default
#   group left_arm_default EXCLUSIVE default
#   group gripper_default EXCLUSIVE default
#   timer arm_move in arm_default (Arm.move) every 1 node=arm
#   timer left_arm_move in left_arm_default (Arm.move) every 1 node=left_arm
#   timer close in gripper_default every 1 node=gripper
