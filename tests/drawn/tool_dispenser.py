"""Tool dispenser: one holder at a time."""

import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Dispenser(Node):
    """Gives the tool to the first who asks."""

    def __init__(self):
        super().__init__('dispenser')
        self.holder = None
        self.granted = []
        shared = ReentrantCallbackGroup()
        for who in ('arm', 'cart'):
            self.create_service(Trigger, f'{who}/claim', self._claim_for(who), callback_group=shared)
            self.create_service(Trigger, f'{who}/free', self._free_for(who), callback_group=shared)

    def _claim_for(self, who):
        def claim(_request, response):
            response.success = self.try_claim(who)
            response.message = str(self.holder)
            return response

        return claim

    def _free_for(self, who):
        def free(_request, response):
            response.success = self.release(who)
            return response

        return free

    def try_claim(self, who):
        if self.holder is None:
            self._unlock_drawer()
            self.holder = who
            self.granted.append(who)
            return True
        return False

    def release(self, who):
        if self.holder == who:
            self.holder = None
            return True
        return False

    def _unlock_drawer(self):
        time.sleep(0.05)


def main():
    rclpy.init()
    node = Dispenser()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
