"""Patrol robot driven by a small behaviour tree."""
import enum
import time

import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Status(enum.Enum):
    RUNNING = 0
    SUCCESS = 1
    FAILURE = 2


class Sequence:
    def __init__(self, *children):
        self.children = children
        self.index = 0

    def tick(self):
        while self.index < len(self.children):
            status = self.children[self.index].tick()
            if status is not Status.SUCCESS:
                return status
            self.index += 1
        return Status.SUCCESS


class DriveTo:
    """Leaf which sends one goal to the navigation server."""

    def __init__(self, node, client, place):
        self.node = node
        self.client = client
        self.place = place
        self.status = None

    def tick(self):
        if self.status is None:
            if not self.client.server_is_ready():
                return Status.RUNNING
            self.node.get_logger().info('driving to place %d' % self.place)
            self.status = Status.RUNNING
            future = self.client.send_goal_async(Fibonacci.Goal(order=self.place))
            future.add_done_callback(self.on_accepted)
        while self.status is Status.RUNNING:
            time.sleep(0.05)
        return self.status

    def on_accepted(self, future):
        handle = future.result()
        if not handle.accepted:
            self.status = Status.FAILURE
            return
        handle.get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        self.status = Status.SUCCESS


class Patrol(Node):
    def __init__(self):
        super().__init__('patrol')
        client = ActionClient(self, Fibonacci, 'drive')
        self.tree = Sequence(*[DriveTo(self, client, p) for p in (3,)])
        self.timer = self.create_timer(0.1, self.tick)

    def tick(self):
        if self.tree.tick() is not Status.RUNNING:
            self.get_logger().info('patrol finished')
            self.timer.cancel()


class Navigation(Node):
    def __init__(self):
        super().__init__('navigation')
        self.server = ActionServer(
            self, Fibonacci, 'drive', self.execute,
            callback_group=ReentrantCallbackGroup())

    def execute(self, goal_handle):
        time.sleep(0.1 * goal_handle.request.order)
        goal_handle.succeed()
        self.get_logger().info('place %d reached' % goal_handle.request.order)
        return Fibonacci.Result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (Patrol(), Navigation()):
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
