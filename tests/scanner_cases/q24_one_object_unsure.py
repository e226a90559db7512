"""Point 24: behind code that is not scanned a second object may be the first; that is said."""
# live: no, these modules do not exist

import rclpy
from common.singletons import OneOfEach, singleton
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from web_frame import shared


@singleton
class Robot(Node):
    def __init__(self):
        super().__init__('robot')


class Arm(Node, metaclass=OneOfEach):
    def __init__(self):
        super().__init__('arm')


@shared.resource
def lamp():
    return Node('lamp')


class Wheel(Node):
    def __init__(self):
        super().__init__('wheel')

    def __new__(cls):
        return shared.get(cls)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (Robot(), Robot(), Arm(), Arm(), lamp(), lamp(), Wheel()):
        executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit robot_and_6_more: MultiThreadedExecutor x4 spin, main
#   nodes robot, robot_2, arm, arm_2, lamp, lamp_2, wheel
#   ? robot_2 entities
#   ? arm_2 entities
#   ? lamp_2 entities
#   ? wheel entities
