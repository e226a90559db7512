"""B4: a library spins the node it was given, which a thread spins already."""

import threading

import rclpy
from pymoveit2 import MoveIt2
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Director(Node):
    def __init__(self):
        super().__init__('director')
        self.create_service(Trigger, 'stop', self.on_stop)

    def on_stop(self, request, response):
        return response


def main():
    rclpy.init()
    node = Director()
    arm = MoveIt2(node, ['joint'], 'base', 'tool', callback_group=ReentrantCallbackGroup())
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    arm.move_to_pose([0.1, 0.2, 0.3], [0.0, 0.0, 0.0, 1.0])
    arm.wait_until_executed()


if __name__ == '__main__':
    main()

# finds: CC406:30 warning, CC501:25 note
